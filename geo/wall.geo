// A wall of bricks, 2 long and 1 high, in running bond: each course of `bricks` stands on the one below with a shift of
// half a brick, every brick meshed by itself. Named "brick_COURSE_NUMBER", all faces of the wall's sides "left",
// "right", "bottom", "top"; of each brick "brick_COURSE_NUMBER_bed" and so on.
DefineConstant[
  bricks = {4, Name "bricks a course"},
  courses = {6, Name "courses"},
  n = {6, Name "elements along a brick"},
  order = {2, Name "order of the elements"},
  kind = {0, Name "0: quadrilaterals, 1: triangles"}
];

k = 0;  // curves and surfaces so far
left[] = {}; right[] = {}; bottom[] = {}; top[] = {};
For j In {0 : courses - 1}
  odd = j % 2;
  For i In {0 : bricks - 1 + odd}
    from = 2 * i - odd; to = from + 2;
    If (from < 0)
      from = 0;
    EndIf
    If (to > 2 * bricks)
      to = 2 * bricks;
    EndIf
    p = newp;
    Point(p) = {from, j, 0}; Point(p + 1) = {to, j, 0}; Point(p + 2) = {to, j + 1, 0}; Point(p + 3) = {from, j + 1, 0};
    c = newl;
    Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Line(c + 3) = {p + 3, p};
    s = news;
    Curve Loop(s) = {c : c + 3};
    Plane Surface(s) = {s};
    // Neighbours' meshes do not match: every other brick has one element more each way.
    m = n + (i + j) % 2;
    Transfinite Curve{c, c + 2} = Ceil(m * (to - from) / 2) + 1;
    Transfinite Curve{c + 1, c + 3} = Ceil(m / 2) + 1;
    Transfinite Surface{s};
    If (kind == 0)
      Recombine Surface{s};
    EndIf
    Physical Surface(Sprintf("brick_%g_%g", j, i)) = {s};
    If (j > 0)
      Physical Curve(Sprintf("brick_%g_%g_bed", j, i)) = {c};
    Else
      bottom[] += c;
    EndIf
    If (j < courses - 1)
      Physical Curve(Sprintf("brick_%g_%g_top", j, i)) = {c + 2};
    Else
      top[] += c + 2;
    EndIf
    If (from > 0)
      Physical Curve(Sprintf("brick_%g_%g_left", j, i)) = {c + 3};
    Else
      left[] += c + 3;
    EndIf
    If (to < 2 * bricks)
      Physical Curve(Sprintf("brick_%g_%g_right", j, i)) = {c + 1};
    Else
      right[] += c + 1;
    EndIf
  EndFor
EndFor
Physical Curve("left") = {left[]};
Physical Curve("right") = {right[]};
Physical Curve("bottom") = {bottom[]};
Physical Curve("top") = {top[]};
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
