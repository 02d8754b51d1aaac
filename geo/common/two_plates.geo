// Macro TwoPlates: an upper plate on a lower one, 0.8 m wide and 0.6 m high together, that meet along the contact line.
// Each plate has its own contact curve with its own nodes; the two curves are the same line and share their end points'
// coordinates. Both plates are structured meshes, n_upper and n_lower elements wide and 3/8 of that high.
// A scene gives, before it calls TwoPlates:
//   Macro LineAt   at x1 = x, the height of the contact line, and its slope where line_kind is "parabola" or "cubics"
//   line_kind      what its pieces are: "straight", an "arc" about arc_x, arc_y, a "parabola" (all three exact), or
//                  "cubics" with the line's heights and slopes at their ends, cubic_steps of them across the width.
//                  (gmsh's Spline has the slope of a chord at its ends: the two meshes would differ there.)
//   knots[]        x1 at the ends of its pieces, 0 ... 0.8; a knot is a vertex of both meshes. A piece between x1 = a and b
//                  takes Round(n b / 0.8) - Round(n a / 0.8) of the n elements
//   spacing        0: the vertices of a piece are even in arc length; 1: they are even in x1, and each element is a piece

Include "body.geo";
width = 0.8;
height_total = 0.6;

// One piece of a contact curve.
//   in   x_b, elements          its right end; elements along it
//        x, height, slope, point   its left end, and the line and the point there; after the call those of the right end
//   out  piece                  the curve
Macro Piece
  x_a = x;
  nodes[] = {point};
  If (StrCmp(line_kind, "parabola") == 0)
    third = (x_b - x_a) / 3;
    p = newp;
    Point(p) = {x_a + third, height + third * slope, 0};
    x = x_b;
    Call LineAt;
    Point(p + 1) = {x_b - third, height - third * slope, 0};
    nodes[] += {p, p + 1};
  EndIf
  If (StrCmp(line_kind, "cubics") == 0)
    steps = Max(2, Ceil(cubic_steps * (x_b - x_a) / width));
    third = (x_b - x_a) / steps / 3;
    cubic_knots[] = {0};
    For j In {1 : steps}
      p = newp;
      Point(p) = {x + third, height + third * slope, 0};
      x = x_a + (x_b - x_a) * j / steps;
      Call LineAt;
      Point(p + 1) = {x - third, height - third * slope, 0};
      nodes[] += {p, p + 1};
      cubic_knots[] += {j - 1, j - 1, j - 1};
      If (j < steps)
        Point(p + 2) = {x, height, 0};
        nodes[] += p + 2;
      EndIf
    EndFor
    cubic_knots[] += {steps, steps, steps, steps};
  EndIf
  x = x_b;
  Call LineAt;
  point = newp;
  Point(point) = {x, height, 0};
  nodes[] += point;

  piece = newc;
  If (StrCmp(line_kind, "straight") == 0)
    Line(piece) = nodes[];
  ElseIf (StrCmp(line_kind, "arc") == 0)
    Circle(piece) = {nodes[0], centre, point};
  ElseIf (StrCmp(line_kind, "parabola") == 0)
    Bezier(piece) = nodes[];
  Else
    Nurbs(piece) = nodes[] Knots cubic_knots[] Order 3;
  EndIf
  Transfinite Curve{piece} = elements + 1;
Return

// One plate's contact curve.
//   in   n               elements along it
//   out  contact[]       its curves, from left to right
//        left, right     its end points
Macro ContactCurve
  ends[] = knots[];
  If (spacing == 1)
    ends[] = {};
    For i In {0 : n}
      ends[] += width * (i / n);
    EndFor
    Mesh.LcIntegrationPrecision = 1e-9;  // no curve is divided; 1e-12 would take seconds on the cubics
  EndIf
  If (StrCmp(line_kind, "arc") == 0)
    centre = newp;
    Point(centre) = {arc_x, arc_y, 0};
  EndIf
  x = ends[0];
  Call LineAt;
  left = newp;
  Point(left) = {x, height, 0};
  point = left;
  contact[] = {};
  For k In {1 : #ends[] - 1}
    x_b = ends[k];
    elements = (spacing == 1) ? 1 : Round(n * x_b / width) - Round(n * x / width);
    Call Piece;
    contact[] += piece;
  EndFor
  right = point;
Return

Macro TwoPlates
  n = n_upper;
  Call ContactCurve;
  a = newp;
  Point(a) = {width, height_total, 0};
  b = newp;
  Point(b) = {0, height_total, 0};
  c = newc;
  Line(c) = {right, a};
  Line(c + 1) = {a, b};
  Line(c + 2) = {b, left};
  Transfinite Curve{c + 1} = n + 1;
  Transfinite Curve{c, c + 2} = Max(1, Round(3 * n / 8)) + 1;
  loop[] = {contact[], c, c + 1, c + 2};
  corners[] = {left, right, a, b};
  Call Body;
  Physical Surface("upper") = {body};
  Physical Curve("upper_contact") = contact[];
  Physical Curve("upper_right") = {c};
  Physical Curve("top") = {c + 1};
  Physical Curve("upper_left") = {c + 2};

  n = n_lower;
  Call ContactCurve;
  a = newp;
  Point(a) = {0, 0, 0};
  b = newp;
  Point(b) = {width, 0, 0};
  c = newc;
  Line(c) = {left, a};
  Line(c + 1) = {a, b};
  Line(c + 2) = {b, right};
  Transfinite Curve{c + 1} = n + 1;
  Transfinite Curve{c, c + 2} = Max(1, Round(3 * n / 8)) + 1;
  loop[] = {c, c + 1, c + 2};
  For k In {1 : #contact[]}
    loop[] += -contact[#contact[] - k];
  EndFor
  corners[] = {a, b, right, left};
  Call Body;
  Physical Surface("lower") = {body};
  Physical Curve("lower_contact") = contact[];
  Physical Curve("lower_left") = {c};
  Physical Curve("bottom") = {c + 1};
  Physical Curve("lower_right") = {c + 2};
Return
