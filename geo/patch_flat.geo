// Two plates that meet along the flat line x2 = 0.3: the contact patch test.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_upper 7, n_lower 11   elements along the contact line of the upper and the lower plate
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_upper = 7, n_lower = 11, order = 2, kind = 0, nine_node = 0, straight = 0 ];
spacing = 0;

Macro LineAt
  height = 0.3;
Return
line_kind = Str("straight");
knots[] = {0, 0.8};

Include "common/two_plates.geo";
Call TwoPlates;
