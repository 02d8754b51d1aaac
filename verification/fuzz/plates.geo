DefineConstant[ n_upper = 3, n_lower = 2, order = 2 ];
Macro Plate
  p = newp; Point(p) = {0, low, 0}; Point(p + 1) = {1, low, 0};
  Point(p + 2) = {1, high, 0}; Point(p + 3) = {0, high, 0};
  c = newc; Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Line(c + 3) = {p + 3, p};
  Transfinite Curve{c, c + 2} = n + 1; Transfinite Curve{c + 1, c + 3} = 2;
  s = news; Curve Loop(s) = {c : c + 3}; Plane Surface(s) = {s}; Transfinite Surface{s}; Recombine Surface{s};
Return
low = 0; high = 0.4; n = n_lower;
Call Plate;
Physical Surface("lower") = {s}; Physical Curve("bottom") = {c}; Physical Curve("lower_top") = {c + 2};
Physical Curve("sides") = {c + 1, c + 3};
low = 0.4; high = 0.9; n = n_upper;
Call Plate;
Physical Surface("upper") = {s}; Physical Curve("upper_bottom") = {c}; Physical Curve("top") = {c + 2};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1;
