// Macro Body: one meshed region inside a loop of curves with four corners, meshed transfinitely.
//   in   loop[]     the curves around it, counterclockwise, signed
//        corners[]  its corner points, counterclockwise
//   out  body       the surface
//   also order, kind, nine_node, straight, the element parameters that every scene defines
// How gmsh 4.8 reads macros: one Call a line, and nothing behind it; a file that is included may define macros that call
// the scene's macros, but must not call them while it is being included.

SetFactory("Built-in");
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1 - nine_node;
Mesh.SecondOrderLinear = straight;
Mesh.LcIntegrationPrecision = 1e-12;  // even in arc length to 1e-6; gmsh's default leaves 2e-5

Macro Body
  around = newll;
  Curve Loop(around) = loop[];
  body = news;
  Plane Surface(body) = {around};
  Transfinite Surface{body} = corners[];
  If (kind == 0)
    Recombine Surface{body};
  EndIf
Return
