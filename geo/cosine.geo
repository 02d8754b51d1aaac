// Two plates that meet along two periods of a cosine, x2 = 0.1 cos(pi (x1 + 0.4) / 0.2) + 0.3
// (Aronov and Rodin 2019, Fig. 29 and eq. (29)).
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_upper 80, n_lower 100   elements along the contact line of the upper and the lower plate
//   spacing 0    contact vertices even in arc length; 1: even in x1
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_upper = 80, n_lower = 100, order = 2, kind = 0, nine_node = 0, straight = 0, spacing = 0 ];

Macro LineAt
  height = 0.1 * Cos(Pi * (x + 0.4) / 0.2) + 0.3;
  slope = -0.5 * Pi * Sin(Pi * (x + 0.4) / 0.2);
Return
line_kind = Str("cubics");
cubic_steps = 400;  // the curve misses the cosine by at most 3e-10 m
knots[] = {0, 0.8};

Include "common/two_plates.geo";
Call TwoPlates;
