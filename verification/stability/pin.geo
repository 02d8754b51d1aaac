// A pin in a hole of a large round plate: the right half, concentric, with a ring beside the contact in either.
// n: elements on a quarter of the pin, 5 n / 4 on one of the hole; clearance and size of the plate in radii;
// kind 0: quadrilaterals; 1: triangles; in rows in the rings
DefineConstant[ n = 60, clearance = 0, size = 40, order = 2, kind = 0, straight = 0 ];
Macro Half  // of a circle about the origin: radius r, m elements a quarter; points and curves p + 1 and more
  Point(p + 1) = {0, -r, 0, h};
  Point(p + 2) = {r, 0, 0, h};
  Point(p + 3) = {0, r, 0, h};
  Circle(p + 1) = {p + 1, 1, p + 2};
  Circle(p + 2) = {p + 2, 1, p + 3};
  Transfinite Curve{p + 1, p + 2} = m + 1;
Return
Macro Ring  // from the circle p to the circle q, and the domain between
  Line(p + 3) = {p + 1, q + 1};
  Line(p + 4) = {p + 3, q + 3};
  Curve Loop(p) = {p + 1, p + 2, p + 4, -(q + 2), -(q + 1), -(p + 3)};
  Plane Surface(p) = {p};
Return
Macro Rows  // of elements, in a ring
  Transfinite Curve{p + 3, p + 4} = Round(0.4 / h) + 1;
  Transfinite Surface{p} = {p + 1, p + 3, q + 3, q + 1};
Return

h = Pi / 2 / n;
m = n;
Point(1) = {0, 0, 0, h};
p = 10; r = 0.6; Call Half;
p = 20; r = 1; Call Half;
h = 0.8 * h;
m = Round(1.25 * n);
p = 30; r = 1 + clearance; Call Half;
p = 40; r = 1.5; Call Half;
h = 0.1 * size;
m = 20;
p = 50; r = size; Call Half;

Line(1) = {13, 1};
Line(2) = {1, 11};
Curve Loop(1) = {11, 12, 1, 2};
Plane Surface(1) = {1};
h = Pi / 2 / n;
p = 10; q = 20;
Call Ring;
Call Rows;
h = 0.8 * h;
p = 30; q = 40;
Call Ring;
Call Rows;
p = 40; q = 50;
Call Ring;
If (kind == 0)
  Recombine Surface{1, 10, 30, 40};
EndIf
Physical Surface("pin") = {1, 10};
Physical Surface("plate") = {30, 40};
Physical Curve("axis") = {1, 2, 13, 14, 33, 34, 43, 44};
Physical Curve("rim") = {51, 52};
Physical Curve("pin_side") = {21, 22};
Physical Curve("hole") = {31, 32};
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
Mesh.SecondOrderLinear = straight;
