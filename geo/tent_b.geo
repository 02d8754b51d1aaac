// Two plates that meet along a tent, two straight lines that rise by 0.2 m to a kink at x1 = 0.4
// (Aronov and Rodin 2019, problem 2(b); the rise is our assumption).
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_upper 80, n_lower 100   elements along the contact line of the upper and the lower plate;
//                at least 2. The kink is always a vertex: an odd number puts the odd element on the left half
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_upper = 80, n_lower = 100, order = 2, kind = 0, nine_node = 0, straight = 0 ];
spacing = 0;

rise = 0.2;
Macro LineAt
  height = 0.3 + rise * (0.5 - Fabs(x - 0.4) / 0.4);
Return
line_kind = Str("straight");
knots[] = {0, 0.4, 0.8};

Include "common/two_plates.geo";
Call TwoPlates;
