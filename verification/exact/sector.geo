// Three sectors of tubes, one in the other, 20 to 70 degrees: "inner" from r = 1 to 2, "outer" to 2.5, "rim" to 3; curves
// "bore", "inner_seat", "outer_hole", "outer_seat", "rim_hole", "ends" and "skin".
DefineConstant[ n = 4 ];
Macro Sector  // from r = a to b, m elements round, k along r
  p = newp;
  Point(p) = {0, 0, 0};
  For i In {0 : 1}
    t = (20 + 50 * i) * Pi / 180;
    Point(p + 1 + 2 * i) = {a * Cos(t), a * Sin(t), 0}; Point(p + 2 + 2 * i) = {b * Cos(t), b * Sin(t), 0};
  EndFor
  l = newl;
  Line(l) = {p + 1, p + 2}; Circle(l + 1) = {p + 2, p, p + 4}; Line(l + 2) = {p + 4, p + 3}; Circle(l + 3) = {p + 3, p, p + 1};
  s = news;
  Curve Loop(s) = {l : l + 3}; Plane Surface(s) = {s};
  Transfinite Curve{l, l + 2} = k + 1; Transfinite Curve{l + 1, l + 3} = m + 1;
  Transfinite Surface{s}; Recombine Surface{s};
Return
a = 1; b = 2; m = n; k = n;
Call Sector;
Physical Surface("inner") = {s}; Physical Curve("bore") = {l + 3}; Physical Curve("inner_seat") = {l + 1}; ends[] = {l, l + 2};
a = 2; b = 2.5; m = Ceil(1.25 * n); k = n;
Call Sector;
Physical Surface("outer") = {s}; Physical Curve("outer_hole") = {l + 3}; Physical Curve("outer_seat") = {l + 1};
ends[] += {l, l + 2};
a = 2.5; b = 3; m = n + 1; k = n;
Call Sector;
Physical Surface("rim") = {s}; Physical Curve("rim_hole") = {l + 3}; Physical Curve("skin") = {l + 1}; ends[] += {l, l + 2};
Physical Curve("ends") = {ends[]};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
