// Two half spherical shells about the origin, x >= 0 the radius (in the plane quarter rings): "inner" between the radii r0
// and c, "outer" between c and r1, from the axis x = 0 to the equator y = 0; curves "bore", "seat", "hole", "rim",
// "equator", "axis".
DefineConstant[ n = 4, order = 2, r0 = 1, c = 2, r1 = 3 ];
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
a = r0; b = c; m = 2 * n; k = n;
Call Shell;
Physical Surface("inner") = {s}; Physical Curve("bore") = {l + 3}; Physical Curve("seat") = {l + 1};
equator[] = {l}; axis[] = {l + 2};
a = c; b = r1; m = Ceil(2.5 * n); k = n;
Call Shell;
Physical Surface("outer") = {s}; Physical Curve("hole") = {l + 3}; Physical Curve("rim") = {l + 1};
Physical Curve("equator") = {equator[], l}; Physical Curve("axis") = {axis[], l + 2};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1;
