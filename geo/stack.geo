// Three plates on one another, 0.8 m wide and 0.2 m high each, that meet along the flat lines x2 = 0.2 and x2 = 0.4.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_upper 7, n_middle 11, n_lower 5   elements along the contact lines of the upper, middle and lower plate
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_upper = 7, n_middle = 11, n_lower = 5, order = 2, kind = 0, nine_node = 0, straight = 0 ];
Include "common/plate.geo";
x_a = 0;
x_b = 0.8;

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
