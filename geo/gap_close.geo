// Two blocks, 0.8 m wide and 0.3 m high each, the upper one 0.1 mm above the lower one.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_upper 7, n_lower 11   elements along the contact lines of the upper and the lower block
//   gap 1e-4     between the blocks, m
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_upper = 7, n_lower = 11, gap = 1e-4, order = 2, kind = 0, nine_node = 0, straight = 0 ];
Include "common/plate.geo";
x_a = 0;
x_b = 0.8;

n = n_upper;
y_a = 0.3 + gap;
y_b = 0.6 + gap;
Call Plate;
Physical Surface("upper") = {body};
Physical Curve("upper_contact") = {c};
Physical Curve("upper_right") = {c + 1};
Physical Curve("top") = {c + 2};
Physical Curve("upper_left") = {c + 3};

n = n_lower;
y_a = 0;
y_b = 0.3;
Call Plate;
Physical Surface("lower") = {body};
Physical Curve("bottom") = {c};
Physical Curve("lower_right") = {c + 1};
Physical Curve("lower_contact") = {c + 2};
Physical Curve("lower_left") = {c + 3};
