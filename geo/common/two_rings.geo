// Two concentric quarter rings in the first quadrant, radii 1 to 2 m (inner) and 2 to 3 m (outer), that meet on the
// circle of radius 2 m. Each has its own contact curve with its own nodes, even in arc length; the elements are about square.
// Parameters: n_inner, n_outer, order, kind, nine_node, straight, which the scene defines.

Include "body.geo";

// One quarter ring.
//   in   r_a, r_b   its radii
//        n          elements along its arcs
//   out  body       the surface
//        c          curves: c on the x1 axis, c + 1 the outer arc, c + 2 on the x2 axis, c + 3 the inner arc
Macro QuarterRing
  p = newp;
  Point(p) = {r_a, 0, 0};
  Point(p + 1) = {r_b, 0, 0};
  Point(p + 2) = {0, r_b, 0};
  Point(p + 3) = {0, r_a, 0};
  Point(p + 4) = {0, 0, 0};
  c = newc;
  Line(c) = {p, p + 1};
  Circle(c + 1) = {p + 1, p + 4, p + 2};
  Line(c + 2) = {p + 2, p + 3};
  Circle(c + 3) = {p + 3, p + 4, p};
  arc_length = Pi / 2 * (r_a + r_b) / 2;
  Transfinite Curve{c + 1, c + 3} = n + 1;
  Transfinite Curve{c, c + 2} = Max(1, Round(n * (r_b - r_a) / arc_length)) + 1;
  loop[] = {c : c + 3};
  corners[] = {p : p + 3};
  Call Body;
Return

r_a = 1;
r_b = 2;
n = n_inner;
Call QuarterRing;
Physical Surface("inner") = {body};
Physical Curve("inner_cut_x") = {c};
Physical Curve("inner_contact") = {c + 1};
Physical Curve("inner_cut_y") = {c + 2};
Physical Curve("inner_bore") = {c + 3};

r_a = 2;
r_b = 3;
n = n_outer;
Call QuarterRing;
Physical Surface("outer") = {body};
Physical Curve("outer_cut_x") = {c};
Physical Curve("outer_rim") = {c + 1};
Physical Curve("outer_cut_y") = {c + 2};
Physical Curve("outer_contact") = {c + 3};
