// Two tubes (or blocks side by side), "inner" for r0 < x < c and "outer" for c < x < r1, 0 < y < height; curves
// "bore", "seat", "hole", "rim", "bottom", "top".
DefineConstant[ n = 4, r0 = 1, c = 2, r1 = 3, height = 0.5, order = 2 ];
Macro Tube  // from a to b, m elements along x, k along y; corners a_low, b_low, b_high, a_high and their lines
  p = newp;
  Point(p) = {a, 0, 0}; Point(p + 1) = {b, 0, 0}; Point(p + 2) = {b, height, 0}; Point(p + 3) = {a, height, 0};
  l = newl;
  Line(l) = {p, p + 1}; Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p + 3}; Line(l + 3) = {p + 3, p};
  s = news;
  Curve Loop(s) = {l : l + 3}; Plane Surface(s) = {s};
  Transfinite Curve{l, l + 2} = m + 1; Transfinite Curve{l + 1, l + 3} = k + 1;
  Transfinite Surface{s}; Recombine Surface{s};
Return
a = r0; b = c; m = n; k = n;
Call Tube;
Physical Surface("inner") = {s};
If (r0 > 0)
  Physical Curve("bore") = {l + 3};
EndIf
Physical Curve("seat") = {l + 1};
bottom[] = {l}; top[] = {l + 2};
a = c; b = r1; m = Ceil(1.5 * n); k = Ceil(1.25 * n);
Call Tube;
Physical Surface("outer") = {s};
Physical Curve("hole") = {l + 3};
Physical Curve("rim") = {l + 1};
Physical Curve("bottom") = {bottom[], l};
Physical Curve("top") = {top[], l + 2};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1;
