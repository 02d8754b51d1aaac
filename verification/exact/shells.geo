// Two half spherical shells about the origin, x >= 0 the radius: "inner" between the radii 1 and 2, "outer" between 2
// and 3, each from the axis x = 0 to the equator y = 0; curves "bore", "seat", "hole", "rim", "equator".
DefineConstant[ n = 4, order = 2 ];
origin = newp; Point(origin) = {0, 0, 0};
Macro Shell  // from radius a to b, m elements along the arc, k across
  p = newp;
  Point(p) = {a, 0, 0}; Point(p + 1) = {b, 0, 0}; Point(p + 2) = {0, b, 0}; Point(p + 3) = {0, a, 0};
  l = newl;
  Line(l) = {p, p + 1}; Circle(l + 1) = {p + 1, origin, p + 2}; Line(l + 2) = {p + 2, p + 3};
  Circle(l + 3) = {p + 3, origin, p};
  s = news;
  Curve Loop(s) = {l : l + 3}; Plane Surface(s) = {s};
  Transfinite Curve{l, l + 2} = k + 1; Transfinite Curve{l + 1, l + 3} = m + 1;
  Transfinite Surface{s}; Recombine Surface{s};
Return
a = 1; b = 2; m = 2 * n; k = n;
Call Shell;
Physical Surface("inner") = {s}; Physical Curve("bore") = {l + 3}; Physical Curve("seat") = {l + 1};
equator[] = {l};
a = 2; b = 3; m = Ceil(2.5 * n); k = n;
Call Shell;
Physical Surface("outer") = {s}; Physical Curve("hole") = {l + 3}; Physical Curve("rim") = {l + 1};
Physical Curve("equator") = {equator[], l};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1;
