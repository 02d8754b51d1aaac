// Two concentric quarter rings, radii 1, 2, 3 m, for pressures inside and outside: the contact on a curve with an exact answer.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_inner 12, n_outer 16   elements along the arcs of the inner and the outer ring
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_inner = 12, n_outer = 16, order = 2, kind = 0, nine_node = 0, straight = 0 ];
Include "common/two_rings.geo";
