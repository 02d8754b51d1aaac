// Quarters of two planes, 0 < x < size, 0 < y < size ("upper") and below ("lower"), which meet along y = 0: the half
// x > 0 of two half planes or half spaces. n: elements of the lower one on 0 < x < fine, 5 n / 4 of the upper one; from
// there they grow. only_fine 1: no contact beyond x = fine. width and height of the upper one, where it is a layer.
DefineConstant[ n = 20, fine = 1.4, size = 100, only_fine = 0, width = 0, height = 0 ];
Macro Quarter  // wide and high, to the side `up` (1 or -1), m elements on the fine part; curves l + 1 and l + 2 are the surface
  h = fine / m;
  p = newp; l = newl; s = news;
  Point(p) = {0, 0, 0, h}; Point(p + 1) = {fine, 0, 0, h}; Point(p + 2) = {wide, 0, 0, far};
  Point(p + 3) = {wide, up * high, 0, far}; Point(p + 4) = {0, up * high, 0, far};
  Line(l + 1) = {p, p + 1}; Line(l + 2) = {p + 1, p + 2}; Line(l + 3) = {p + 2, p + 3};
  Line(l + 4) = {p + 3, p + 4}; Line(l + 5) = {p + 4, p};
  Transfinite Curve{l + 1} = m + 1;
  Curve Loop(s) = {l + 1 : l + 5}; Plane Surface(s) = {s};
Return
wide = size; high = size; far = size / 6; m = n; up = -1; Call Quarter;
lower = l;
Physical Surface("lower") = {s};
m = Round(1.25 * n); up = 1;
If (width)
  wide = width; high = height; far = 3 * fine / n;
EndIf
Call Quarter;
Physical Surface("upper") = {s};
If (only_fine)
  Physical Curve("lower_contact") = {lower + 1};
  Physical Curve("upper_contact") = {l + 1};
Else
  Physical Curve("lower_contact") = {lower + 1, lower + 2};
  Physical Curve("upper_contact") = {l + 1, l + 2};
EndIf
Physical Curve("axis") = {lower + 5, l + 5};
Physical Curve("ground") = {lower + 4};
Physical Curve("head") = {l + 4};
Mesh.ElementOrder = 2;
