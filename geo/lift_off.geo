// A plate, 0.8 m long and 0.1 m high, on a block of the same length, 0.3 m high.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_plate 64, n_block 80   elements along the contact lines of the plate and the block
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_plate = 64, n_block = 80, order = 2, kind = 0, nine_node = 0, straight = 0 ];
Include "common/plate.geo";
x_a = 0;
x_b = 0.8;

n = n_plate;
y_a = 0.3;
y_b = 0.4;
Call Plate;
Physical Surface("plate") = {body};
Physical Curve("plate_contact") = {c};
Physical Curve("plate_right") = {c + 1};
Physical Curve("plate_top") = {c + 2};
Physical Curve("plate_left") = {c + 3};

n = n_block;
y_a = 0;
y_b = 0.3;
Call Plate;
Physical Surface("block") = {body};
Physical Curve("bottom") = {c};
Physical Curve("block_right") = {c + 1};
Physical Curve("block_contact") = {c + 2};
Physical Curve("block_left") = {c + 3};
