// A half cylinder on a block, the half x1 >= 0 of both, meshed finely where they will touch: around the origin.
// Parameters (gmsh -setnumber NAME VALUE) and their defaults:
//   n_upper 20, n_lower 25   elements on half_width along the contact lines of the cylinder and the block
//   half_width 0.01          half the width of the contact, about: the mesh is finest up to 1.25 times that
//   radius 1                 of the cylinder
//   block_width 1, block_height 1   of the block's half
//   order 2      quadratic elements; 1: linear
//   kind 0       quadrilaterals; 1: triangles
//   nine_node 0  8-node quadrilaterals; 1: 9-node (order 2)
//   straight 0   second-order nodes on the curve; 1: at the middles of straight edges (order 2)

DefineConstant[ n_upper = 20, n_lower = 25, half_width = 0.01, radius = 1, block_width = 1, block_height = 1,
                order = 2, kind = 0, nine_node = 0, straight = 0 ];
Include "common/body.geo";

growth = 1.2;  // from one element to the next, away from the contact
fine = 1.25 * half_width;

// How many elements a length takes if the first is as long as those of the contact.
//   in   n, length_graded
//   out  elements
Macro Graded
  elements = Ceil(Log(1 + length_graded * (growth - 1) * n / half_width) / Log(growth));
Return

// gmsh blends the sides of a quadrilateral by the spacing on the two between its first three corners: corners[] starts
// so that these two meet at the contact.

// The cylinder: three quadrilaterals. The first, below, has the contact in its lower left corner.
//
//   centre --- top --- edge
//     |         |       /
//     |   third | second
//   axis ---- inner    /
//     |           \   /
//     |  first     arc_end
//     |        _ /
//   foot - fine_end
n = n_upper;
n_fine = Ceil(1.25 * n);
foot = newp;
Point(foot) = {0, 0, 0};
fine_end = newp;
Point(fine_end) = {radius * Sin(fine / radius), radius * (1 - Cos(fine / radius)), 0};
arc_end = newp;
Point(arc_end) = {radius * Sin(Pi / 4), radius * (1 - Cos(Pi / 4)), 0};
edge = newp;
Point(edge) = {radius, radius, 0};
top = newp;
Point(top) = {0.5 * radius, radius, 0};
centre = newp;
Point(centre) = {0, radius, 0};
axis = newp;
Point(axis) = {0, 0.5 * radius, 0};
inner = newp;
Point(inner) = {0.4 * radius, 0.6 * radius, 0};
fine_axis = newp;
Point(fine_axis) = {0, fine, 0};

c = newc;
Circle(c) = {foot, centre, fine_end};
Circle(c + 1) = {fine_end, centre, arc_end};
Circle(c + 2) = {arc_end, centre, edge};
Line(c + 3) = {edge, top};
Line(c + 4) = {top, centre};
Line(c + 5) = {centre, axis};
Line(c + 6) = {axis, fine_axis};
Line(c + 7) = {arc_end, inner};
Line(c + 8) = {inner, axis};
Line(c + 9) = {inner, top};
Line(c + 10) = {fine_axis, foot};
Transfinite Curve{c, c + 10} = n_fine + 1;
length_graded = radius * Pi / 4 - fine;
Call Graded;
Transfinite Curve{c + 1} = elements + 1 Using Progression growth;
Transfinite Curve{c + 8, c + 4} = n_fine + elements + 1;
length_graded = 0.5 * radius - fine;
Call Graded;
Transfinite Curve{-(c + 6)} = elements + 1 Using Progression growth;
Transfinite Curve{c + 7} = n_fine + elements + 1;
Transfinite Curve{c + 3} = n_fine + elements + 1;
Transfinite Curve{c + 2, c + 9, c + 5} = Ceil(elements / 4) + 1;

loop[] = {c, c + 1, c + 7, c + 8, c + 6, c + 10};
corners[] = {axis, foot, arc_end, inner};
Call Body;
cylinder[] = {body};
loop[] = {c + 2, c + 3, -(c + 9), -(c + 7)};
corners[] = {arc_end, edge, top, inner};
Call Body;
cylinder[] += {body};
loop[] = {c + 9, c + 4, c + 5, -(c + 8)};
corners[] = {inner, top, centre, axis};
Call Body;
cylinder[] += {body};
Physical Surface("cylinder") = cylinder[];
Physical Curve("cylinder_foot") = {c, c + 1};
Physical Curve("head") = {c + 3, c + 4};
Physical Curve("cylinder_axis") = {c + 5, c + 6, c + 10};

// The block: one quadrilateral, its top left corner at the contact.
n = n_lower;
n_fine = Ceil(1.25 * n);
p = newp;
Point(p) = {0, -block_height, 0};
Point(p + 1) = {block_width, -block_height, 0};
Point(p + 2) = {block_width, 0, 0};
Point(p + 3) = {fine, 0, 0};
Point(p + 4) = {0, 0, 0};
Point(p + 5) = {0, -fine, 0};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p + 3};
Line(c + 3) = {p + 3, p + 4};
Line(c + 4) = {p + 4, p + 5};
Line(c + 5) = {p + 5, p};
Transfinite Curve{c + 3, c + 4} = n_fine + 1;
length_graded = block_width - fine;
Call Graded;
Transfinite Curve{-(c + 2)} = elements + 1 Using Progression growth;
Transfinite Curve{c} = n_fine + elements + 1;
length_graded = block_height - fine;
Call Graded;
Transfinite Curve{c + 5} = elements + 1 Using Progression growth;
Transfinite Curve{-(c + 1)} = n_fine + elements + 1;
loop[] = {c : c + 5};
corners[] = {p + 2, p + 4, p, p + 1};
Call Body;
Transfinite Surface{body} = corners[] Right;  // triangles that mirror those of the cylinder
Physical Surface("block") = {body};
Physical Curve("ground") = {c};
Physical Curve("block_top") = {c + 2, c + 3};
Physical Curve("block_axis") = {c + 4, c + 5};
