// Two plates, "lower" and "upper", that meet along y = c0 + c1 x + c2 x^2 between x = x0 and x0 + 1; the lower one reaches
// down to y = 0, the upper one up to y = 1. Curves "lower_contact", "upper_contact", "bottom", "top",
// and "lower_left", "lower_right", "upper_left", "upper_right".
DefineConstant[ n_lower = 8, n_upper = 10, order = 2, kind = 0, nine_node = 0, free = 0, x0 = 0, c0 = 0.5, c1 = 0, c2 = 0 ];
x1 = x0 + 1;
y0 = c0 + c1 * x0 + c2 * x0^2; y1 = c0 + c1 * x1 + c2 * x1^2;
s0 = c1 + 2 * c2 * x0; s1 = c1 + 2 * c2 * x1;
Macro Plate  // between the contact line and y = far, n elements wide
  p = newp;
  Point(p) = {x0, y0, 0}; Point(p + 1) = {x1, y1, 0}; Point(p + 2) = {x1, far, 0}; Point(p + 3) = {x0, far, 0};
  Point(p + 4) = {x0 + 1/3, y0 + s0 / 3, 0}; Point(p + 5) = {x1 - 1/3, y1 - s1 / 3, 0};
  l = newl;
  Bezier(l) = {p, p + 4, p + 5, p + 1};
  Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p + 3}; Line(l + 3) = {p + 3, p};
  Transfinite Curve{l, l + 2} = n + 1; Transfinite Curve{l + 1, l + 3} = Max(2, Round(n / 2)) + 1;
  s = news;
  If (far > c0)
    Curve Loop(s) = {l, l + 1, l + 2, l + 3};
  Else
    Curve Loop(s) = {-(l + 3), -(l + 2), -(l + 1), -l};
  EndIf
  Plane Surface(s) = {s};
  If (!free)
    Transfinite Surface{s} = {p, p + 1, p + 2, p + 3};
  EndIf
  If (kind == 0)
    Recombine Surface{s};
  EndIf
Return
Mesh.LcIntegrationPrecision = 1e-12;
far = 0; n = n_lower;
Call Plate;
Physical Surface("lower") = {s}; Physical Curve("lower_contact") = {l}; Physical Curve("bottom") = {l + 2};
Physical Curve("lower_left") = {l + 3}; Physical Curve("lower_right") = {l + 1};
far = 1; n = n_upper;
Call Plate;
Physical Surface("upper") = {s}; Physical Curve("upper_contact") = {l}; Physical Curve("top") = {l + 2};
Physical Curve("upper_left") = {l + 3}; Physical Curve("upper_right") = {l + 1};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1 - nine_node;
