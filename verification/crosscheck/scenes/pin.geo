// A pin with a bore in the hole of a round plate, concentric and without clearance: closed contact curves.
// n_pin 20, n_hole 28: elements around each, multiples of 4; size: of the plate, in radii of the pin
// order 2, kind 1, straight 1: quadratic triangles with straight sides
DefineConstant[ n_pin = 20, n_hole = 28, size = 4, order = 2, kind = 1, straight = 1 ];
Point(1) = {0, 0, 0};

Macro Ring  // radius r, n elements around; points, curves and loop from p on
  For k In {0 : 3}
    Point(p + k) = {r * Cos(Pi / 2 * k), r * Sin(Pi / 2 * k), 0, 2 * Pi * r / n};
  EndFor
  For k In {0 : 3}
    Circle(p + k) = {p + k, 1, p + (k + 1) % 4};
    Transfinite Curve{p + k} = n / 4 + 1;
  EndFor
  Curve Loop(p) = {p : p + 3};
Return

p = 10; r = 0.4; n = 8; Call Ring;
p = 20; r = 1; n = n_pin; Call Ring;
p = 30; r = 1; n = n_hole; Call Ring;
p = 40; r = size; n = 12; Call Ring;
Plane Surface(1) = {20, 10};
Plane Surface(2) = {40, 30};
Physical Surface("pin") = {1};
Physical Surface("plate") = {2};
Physical Curve("bore") = {10 : 13};
Physical Curve("pin_side") = {20 : 23};
Physical Curve("hole") = {30 : 33};
Physical Curve("rim") = {40 : 43};
Mesh.ElementOrder = order;
Mesh.SecondOrderLinear = straight;
