// Logs of radius 1 stacked in a bin that is narrower than two of them: each lies on the one below and against a wall, now the
// right one, now the left. Bodies "bin", "log_NUMBER" from the bottom; curves "floor", "west", "east" (inside), "outside",
// "rim_NUMBER".
DefineConstant[
  logs = {5, Name "logs"},
  width = {3.2, Name "inner width of the bin, above 2 and below 4"},
  fine = {0.02, Name "edges at the contacts"},
  coarse = {0.25, Name "edges elsewhere"},
  order = {2, Name "order of the elements"}
];

shift = width - 2;             // from a centre to the next, across
rise = Sqrt(4 - shift ^ 2);    // and upwards
height = 1 + rise * logs;

// Points of the walls where logs touch them, from the bottom: the left ones under the even logs.
p = newp;
Point(p) = {-1, -1, 0, coarse}; Point(p + 1) = {width + 1, -1, 0, coarse};
Point(p + 2) = {width + 1, height, 0, coarse}; Point(p + 3) = {width, height, 0, coarse};
Point(p + 4) = {width, 0, 0, coarse}; Point(p + 5) = {1, 0, 0, fine}; Point(p + 6) = {0, 0, 0, coarse};
Point(p + 7) = {0, height, 0, coarse}; Point(p + 8) = {-1, height, 0, coarse};
west[] = {p + 6}; east[] = {p + 4};
For k In {0 : logs - 1}
  q = newp;
  If (k % 2 == 0)
    Point(q) = {0, 1 + rise * k, 0, fine}; west[] += q;
  Else
    Point(q) = {width, 1 + rise * k, 0, fine}; east[] += q;
  EndIf
EndFor
west[] += p + 7; east[] += p + 3;
west_lines[] = {}; east_lines[] = {};
For k In {0 : #west[] - 2}
  l = newl; Line(l) = {west[k], west[k + 1]}; west_lines[] += l;
EndFor
For k In {0 : #east[] - 2}
  l = newl; Line(l) = {east[k + 1], east[k]}; east_lines[] += l;
EndFor
l = newl;
Line(l) = {p + 4, p + 5}; Line(l + 1) = {p + 5, p + 6};
Line(l + 2) = {p + 7, p + 8}; Line(l + 3) = {p + 8, p}; Line(l + 4) = {p, p + 1}; Line(l + 5) = {p + 1, p + 2};
Line(l + 6) = {p + 2, p + 3};
s = news;
Curve Loop(s) = {l, l + 1, west_lines[], l + 2 : l + 6, east_lines[{#east_lines[] - 1 : 0 : -1}]};
Plane Surface(s) = {s};
Physical Surface("bin") = {s};
Physical Curve("floor") = {l, l + 1};
Physical Curve("west") = {west_lines[]};
Physical Curve("east") = {east_lines[]};
Physical Curve("outside") = {l + 3 : l + 5};

// A log's arcs end where it touches: the wall, the log below (or the floor) and the log above.
For k In {0 : logs - 1}
  side = k % 2 == 0 ? 1 : -1;  // to the right of it is the next
  x = k % 2 == 0 ? 1 : width - 1;
  y = 1 + rise * k;
  o = newp;
  Point(o) = {x, y, 0, coarse};
  Point(o + 1) = {x - side, y, 0, fine};
  If (k == 0)
    Point(o + 2) = {x, y - 1, 0, fine};
  Else
    Point(o + 2) = {x + side * shift / 2, y - rise / 2, 0, fine};
  EndIf
  Point(o + 3) = {x + side * shift / 2, y + rise / 2, 0, k < logs - 1 ? fine : coarse};
  Point(o + 4) = {x - side * shift / 2, y + rise / 2, 0, coarse};
  c = newl;
  Circle(c) = {o + 1, o, o + 2}; Circle(c + 1) = {o + 2, o, o + 3};
  Circle(c + 2) = {o + 3, o, o + 4}; Circle(c + 3) = {o + 4, o, o + 1};
  s = news;
  Curve Loop(s) = {c : c + 3};
  Plane Surface(s) = {s};
  Physical Surface(Sprintf("log_%g", k)) = {s};
  Physical Curve(Sprintf("rim_%g", k)) = {c : c + 3};
EndFor
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
Mesh.MeshSizeExtendFromBoundary = 1;
