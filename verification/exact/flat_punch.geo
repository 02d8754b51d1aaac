// A cylinder of radius 1 and height 1, "punch", on a block of radius 4 and height 4, "ground": the meridian plane, the
// axis is x = 0. Curves "punch_contact", "ground_contact" (0 < x < 1), "far" (the block's bottom and rim). Meshes
// are graded to the edge at x = 1, the smallest element n times smaller than the largest.
DefineConstant[ n = 4, order = 2 ];
Macro Graded  // a < x < b, c < y < d; m elements along x, k along y; finer to the end `east` (1) or west (-1) and y = 0
  p = newp;
  Point(p) = {a, c, 0}; Point(p + 1) = {b, c, 0}; Point(p + 2) = {b, d, 0}; Point(p + 3) = {a, d, 0};
  l = newl;
  Line(l) = {p, p + 1}; Line(l + 1) = {p + 1, p + 2}; Line(l + 2) = {p + 2, p + 3}; Line(l + 3) = {p + 3, p};
  s = news;
  Curve Loop(s) = {l : l + 3}; Plane Surface(s) = {s};
  along_x = n^(-1 * east / (m - 1)); along_y = n^(-1 * up / (k - 1));
  Transfinite Curve{l, -(l + 2)} = m + 1 Using Progression along_x;
  Transfinite Curve{l + 1, -(l + 3)} = k + 1 Using Progression along_y;
  Transfinite Surface{s}; Recombine Surface{s};
Return
a = 0; b = 1; c = 0; d = 1; m = n; k = n; east = 1; up = -1;
Call Graded;
Physical Surface("punch") = {s}; Physical Curve("punch_contact") = {l};
c = -4; d = 0; m = Ceil(1.25 * n); k = 2 * n; up = 1;
Call Graded;
inner = s; Physical Curve("ground_contact") = {l + 2}; bottom = l; between = l + 1;
// The rest of the block has the side between in common.
p = newp; Point(p) = {4, -4, 0}; Point(p + 1) = {4, 0, 0};
corners[] = Boundary{ Curve{between}; };
l = newl;
Line(l) = {corners[0], p}; Line(l + 1) = {p, p + 1}; Line(l + 2) = {p + 1, corners[1]};
s = news; Curve Loop(s) = {l, l + 1, l + 2, -between}; Plane Surface(s) = {s};
m = 2 * n;
Transfinite Curve{l, -(l + 2)} = m + 1 Using Progression n^(1 / (m - 1));
Transfinite Curve{l + 1} = k + 1 Using Progression n^(-1 / (k - 1));
Transfinite Surface{s}; Recombine Surface{s};
Physical Surface("ground") = {inner, s}; Physical Curve("far") = {bottom, l, l + 1};
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 1;
