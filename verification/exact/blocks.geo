// Two blocks, "lower" for 0 < y < 1 and "upper" for 1 < y < top; curves "ground", "lower_contact", "upper_contact", "head",
// "left" and "right". n, n_upper: elements along x.
DefineConstant[ n = 4, n_upper = Ceil(1.25 * n), order = 2, width = 2, top = 1.5 ];
Macro Storey  // from y = a to b, m elements along x, k along y
  p = newp;
  Point(p) = {0, a, 0}; Point(p + 1) = {width, a, 0}; Point(p + 2) = {width, b, 0}; Point(p + 3) = {0, b, 0};
  l = newl;
  Line(l) = {p, p + 1}; Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p + 3}; Line(l + 3) = {p + 3, p};
  s = news;
  Curve Loop(s) = {l : l + 3}; Plane Surface(s) = {s};
  Transfinite Curve{l, l + 2} = m + 1; Transfinite Curve{l + 1, l + 3} = k + 1;
  Transfinite Surface{s}; Recombine Surface{s};
Return
a = 0; b = 1; m = n; k = n;
Call Storey;
Physical Surface("lower") = {s}; Physical Curve("ground") = {l}; Physical Curve("lower_contact") = {l + 2};
right[] = {l + 1}; left[] = {l + 3};
a = 1; b = top; m = n_upper; k = n;
Call Storey;
Physical Surface("upper") = {s}; Physical Curve("upper_contact") = {l}; Physical Curve("head") = {l + 2};
Physical Curve("right") = {right[], l + 1}; Physical Curve("left") = {left[], l + 3};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1;
