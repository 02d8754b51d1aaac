// Macro Plate: one rectangle, meshed in about square elements.
//   in   x_a, x_b, y_a, y_b   its sides
//        n                    elements along x1
//   out  body                 the surface
//        c                    curves: c below, c + 1 right, c + 2 above, c + 3 left
// Parameters: order, kind, nine_node, straight, which the scene defines.

Include "body.geo";

Macro Plate
  p = newp;
  Point(p) = {x_a, y_a, 0};
  Point(p + 1) = {x_b, y_a, 0};
  Point(p + 2) = {x_b, y_b, 0};
  Point(p + 3) = {x_a, y_b, 0};
  c = newc;
  Line(c) = {p, p + 1};
  Line(c + 1) = {p + 1, p + 2};
  Line(c + 2) = {p + 2, p + 3};
  Line(c + 3) = {p + 3, p};
  Transfinite Curve{c, c + 2} = n + 1;
  Transfinite Curve{c + 1, c + 3} = Max(1, Round(n * (y_b - y_a) / (x_b - x_a))) + 1;
  loop[] = {c : c + 3};
  corners[] = {p : p + 3};
  Call Body;
Return
