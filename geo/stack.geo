// Three plates on one another, 0.8 m wide and 0.2 m high each, that meet along the flat lines x2 = 0.2 and x2 = 0.4.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_upper 7, n_middle 11, n_lower 5   elements along the contact lines of the upper, middle and lower plate
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_upper = 7, n_middle = 11, n_lower = 5, order = 2, kind = 0, nine_node = 0, straight = 0 ];
Include "common/body.geo";
width = 0.8;

// One plate, n elements wide, from x2 = y_a to y_b; its curves: c below, c + 1 right, c + 2 above, c + 3 left.
Macro Plate
  p = newp;
  Point(p) = {0, y_a, 0};
  Point(p + 1) = {width, y_a, 0};
  Point(p + 2) = {width, y_b, 0};
  Point(p + 3) = {0, y_b, 0};
  c = newc;
  Line(c) = {p, p + 1};
  Line(c + 1) = {p + 1, p + 2};
  Line(c + 2) = {p + 2, p + 3};
  Line(c + 3) = {p + 3, p};
  Transfinite Curve{c, c + 2} = n + 1;
  Transfinite Curve{c + 1, c + 3} = Max(1, Round(n * (y_b - y_a) / width)) + 1;
  loop[] = {c : c + 3};
  corners[] = {p : p + 3};
  Call Body;
Return

n = n_upper;
y_a = 0.4;
y_b = 0.6;
Call Plate;
Physical Surface("upper") = {body};
Physical Curve("upper_contact") = {c};
Physical Curve("upper_right") = {c + 1};
Physical Curve("top") = {c + 2};
Physical Curve("upper_left") = {c + 3};

n = n_middle;
y_a = 0.2;
y_b = 0.4;
Call Plate;
Physical Surface("middle") = {body};
Physical Curve("middle_bottom") = {c};
Physical Curve("middle_right") = {c + 1};
Physical Curve("middle_top") = {c + 2};
Physical Curve("middle_left") = {c + 3};

n = n_lower;
y_a = 0;
y_b = 0.2;
Call Plate;
Physical Surface("lower") = {body};
Physical Curve("bottom") = {c};
Physical Curve("lower_right") = {c + 1};
Physical Curve("lower_contact") = {c + 2};
Physical Curve("lower_left") = {c + 3};
