// A flat-ended punch, 0.2 m wide and 0.1 m high, on the middle of a block, 0.6 m wide and 0.2 m high.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_punch 40, n_block 90   elements along the contact lines of the punch and the block
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_punch = 40, n_block = 90, order = 2, kind = 0, nine_node = 0, straight = 0 ];
Include "common/plate.geo";

n = n_punch;
x_a = 0.2;
x_b = 0.4;
y_a = 0.2;
y_b = 0.3;
Call Plate;
Physical Surface("punch") = {body};
Physical Curve("foot") = {c};
Physical Curve("head") = {c + 2};

n = n_block;
x_a = 0;
x_b = 0.6;
y_a = 0;
y_b = 0.2;
Call Plate;
Physical Surface("block") = {body};
Physical Curve("ground") = {c};
Physical Curve("block_top") = {c + 2};
