// Macro TwoPlates: an upper plate on a lower one, 0.8 m wide and 0.6 m high together, that meet along the contact line.
// Each plate has its own contact curve with its own nodes; the two curves are the same line and share their end points'
// coordinates. Both plates are structured meshes, n_upper and n_lower elements wide and 3/8 of that high.
// A scene gives, before it calls TwoPlates:
//   Macro LineAt   at x1 = x, the height of the contact line, and its slope where line_kind is "cubic"
//   line_kind      of what its pieces are made: "straight" lines, an "arc" about arc_x, arc_y, or "cubic" Hermite
//                  polynomials in x1, no longer than cubic_length along x1, which also follow any parabola exactly
//   knots[]        x1 at the ends of its pieces, 0 ... 0.8; a knot is a vertex of both meshes. A piece between x1 = a and b
//                  takes Round(n b / 0.8) - Round(n a / 0.8) of the n elements
//   spacing        0: the vertices of a piece are even in arc length; 1: the vertices are even in x1
// Where the vertices' places are computed here (spacing 1, and a line of many cubics: gmsh takes minutes to divide one), each
// element is a curve of its own.

Include "body.geo";
width = 0.8;
height_total = 0.6;

// One piece of a contact curve with `elements` elements.
//   in   x_a, x_b        its ends
//        point, height, slope   the point at x_a, and the line there
//   out  piece           the curve; point, height and slope are those of x_b now
Macro Piece
  pieces = 1;
  If (StrCmp(line_kind, "cubic") == 0)
    pieces = Ceil((x_b - x_a) / cubic_length - 1e-9);
  EndIf
  third = (x_b - x_a) / (3 * pieces);
  nodes[] = {point};
  For j In {1 : pieces}
    If (StrCmp(line_kind, "cubic") == 0)
      point = newp;
      Point(point) = {x + third, height + third * slope, 0};
      nodes[] += point;
    EndIf
    x = x_a * (1 - j / pieces) + x_b * (j / pieces);
    Call LineAt;
    If (StrCmp(line_kind, "cubic") == 0)
      point = newp;
      Point(point) = {x - third, height - third * slope, 0};
      nodes[] += point;
    EndIf
    point = newp;
    Point(point) = {x, height, 0};
    nodes[] += point;
  EndFor
  piece = newc;
  If (StrCmp(line_kind, "cubic") == 0)
    Bezier(piece) = nodes[];
  ElseIf (StrCmp(line_kind, "arc") == 0)
    Circle(piece) = {nodes[0], centre, point};
  Else
    Line(piece) = nodes[];
  EndIf
  Transfinite Curve{piece} = elements + 1;
Return

// Arc length of the contact line by Gauss's rule with three points.
//   in   x_a, x_b
//   out  arc
Macro ArcLength
  arc = 0;
  For g In {-1 : 1}
    x = (x_a + x_b) / 2 + g * Sqrt(0.6) * (x_b - x_a) / 2;
    Call LineAt;
    arc += (8 - 3 * Fabs(g)) / 18 * (x_b - x_a) * Sqrt(1 + slope^2);
  EndFor
Return

// Where n elements of equal arc length end: Newton's method on the arc length, summed over cells one cubic long.
//   in   n
//   out  ends[]
Macro EvenArcLength
  cells = Ceil(width / cubic_length - 1e-9);
  arcs[] = {0};
  For j In {1 : cells}
    x_a = width * ((j - 1) / cells);
    x_b = width * (j / cells);
    Call ArcLength;
    arcs[] += arcs[j - 1] + arc;
  EndFor
  ends[] = {0};
  For i In {1 : n - 1}
    x_b = width * (i / n);
    For k In {1 : 6}
      j = Floor(cells * x_b / width);
      x_a = width * (j / cells);
      Call ArcLength;
      x = x_b;
      Call LineAt;
      x_b += (arcs[cells] * i / n - arcs[j] - arc) / Sqrt(1 + slope^2);
    EndFor
    ends[] += x_b;
  EndFor
  ends[] += width;
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
  ElseIf (StrCmp(line_kind, "cubic") == 0)
    If (cubic_length < width)
      Call EvenArcLength;
    EndIf
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
    x_a = ends[k - 1];
    x_b = ends[k];
    elements = (#ends[] == n + 1) ? 1 : Round(n * x_b / width) - Round(n * x_a / width);
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
