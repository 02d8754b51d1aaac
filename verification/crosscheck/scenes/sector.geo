// A sector of a shaft and of a ring on it, of 60 degrees, from 20 degrees to 80 about the origin; radii 1, 2 and 3 m.
// Parameters: n_shaft, n_ring   elements along the arcs
//             order, kind, straight   as of the scenes in geo/; triangles only
// The meshes of the two cuts of a body do not match.
DefineConstant[ n_shaft = 6, n_ring = 8, order = 2, kind = 1, straight = 0 ];
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
Mesh.SecondOrderLinear = straight;
a = Pi / 9; b = a + Pi / 3;
Point(1) = {0, 0, 0};

// A body between radii r and s: its low cut has more elements than its high one.
Macro Sector
  p = newp;
  Point(p) = {r * Cos(a), r * Sin(a), 0}; Point(p + 1) = {s * Cos(a), s * Sin(a), 0};
  Point(p + 2) = {s * Cos(b), s * Sin(b), 0}; Point(p + 3) = {r * Cos(b), r * Sin(b), 0};
  c = newc;
  Line(c) = {p, p + 1}; Circle(c + 1) = {p + 1, 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Circle(c + 3) = {p + 3, 1, p};
  Transfinite Curve{c + 1, c + 3} = n + 1;
  Transfinite Curve{c} = n + 1;
  Transfinite Curve{c + 2} = Ceil(0.7 * n) + 1;
  Curve Loop(c) = {c : c + 3};
  body = news;
  Plane Surface(body) = {c};
Return

r = 1; s = 2; n = n_shaft;
Call Sector;
Physical Surface("shaft") = {body};
Physical Curve("shaft_low") = {c}; Physical Curve("seat") = {c + 1}; Physical Curve("shaft_high") = {c + 2};
Physical Curve("core") = {c + 3};

r = 2; s = 3; n = n_ring;
Call Sector;
Physical Surface("ring") = {body};
Physical Curve("ring_low") = {c}; Physical Curve("rim") = {c + 1}; Physical Curve("ring_high") = {c + 2};
Physical Curve("bore") = {c + 3};
