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

// Counts of elements that a scene defines are whole and at least 1.
If (Exists(n_block))
  If (n_block < 1 || n_block != Floor(n_block))
    Error("n_block = %g: expected a whole number of elements, at least 1", n_block);
  EndIf
EndIf
If (Exists(n_inner))
  If (n_inner < 1 || n_inner != Floor(n_inner))
    Error("n_inner = %g: expected a whole number of elements, at least 1", n_inner);
  EndIf
EndIf
If (Exists(n_lower))
  If (n_lower < 1 || n_lower != Floor(n_lower))
    Error("n_lower = %g: expected a whole number of elements, at least 1", n_lower);
  EndIf
EndIf
If (Exists(n_middle))
  If (n_middle < 1 || n_middle != Floor(n_middle))
    Error("n_middle = %g: expected a whole number of elements, at least 1", n_middle);
  EndIf
EndIf
If (Exists(n_outer))
  If (n_outer < 1 || n_outer != Floor(n_outer))
    Error("n_outer = %g: expected a whole number of elements, at least 1", n_outer);
  EndIf
EndIf
If (Exists(n_plate))
  If (n_plate < 1 || n_plate != Floor(n_plate))
    Error("n_plate = %g: expected a whole number of elements, at least 1", n_plate);
  EndIf
EndIf
If (Exists(n_punch))
  If (n_punch < 1 || n_punch != Floor(n_punch))
    Error("n_punch = %g: expected a whole number of elements, at least 1", n_punch);
  EndIf
EndIf
If (Exists(n_upper))
  If (n_upper < 1 || n_upper != Floor(n_upper))
    Error("n_upper = %g: expected a whole number of elements, at least 1", n_upper);
  EndIf
EndIf

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
