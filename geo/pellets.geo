// A fuel rod's section along its axis x = 0, lengths in mm: a column of pellets of radius 4 and height 8, dished and
// chamfered, in a cladding 0.6 thick, with a gap of 0.02 between. Bodies "pellet_NUMBER" from below, "cladding"; curves
// "axis", "bottom" of the lowest pellet, "top" of the highest, "foot" and "outside" of the cladding, "inside" its face to
// the pellets, "pellet_NUMBER_side", "pellet_NUMBER_bottom", "pellet_NUMBER_top".
DefineConstant[
  pellets = {10, Name "pellets"},
  n = {6, Name "elements along a pellet's radius"},
  order = {2, Name "order of the elements"},
  whole_faces = {0, Name "faces of 0: what touches at first, 1: with the dish"},
  kind = {0, Name "cladding of 0: quadrilaterals, 1: triangles"}
];
radius = 4; height = 8; gap = 0.02; thickness = 0.6; dish = 0.02; chamfer = 0.3;
axis[] = {};
For k In {0 : pellets - 1}
  y = k * height;
  h = radius / (n + k % 2);  // neighbours' meshes do not match
  p = newp;
  Point(p) = {0, y + dish, 0, h}; Point(p + 1) = {radius - 2.5 * chamfer, y, 0, h / 2};
  Point(p + 2) = {radius - chamfer, y, 0, h / 4}; Point(p + 3) = {radius, y + chamfer, 0, h / 4};
  Point(p + 4) = {radius, y + height - chamfer, 0, h / 4}; Point(p + 5) = {radius - chamfer, y + height, 0, h / 4};
  Point(p + 6) = {radius - 2.5 * chamfer, y + height, 0, h / 2}; Point(p + 7) = {0, y + height - dish, 0, h};
  c = newl;
  For i In {0 : 6}
    Line(c + i) = {p + i, p + i + 1};
  EndFor
  Line(c + 7) = {p + 7, p};
  s = news;
  Curve Loop(s) = {c : c + 7};
  Plane Surface(s) = {s};
  Physical Surface(Sprintf("pellet_%g", k)) = {s};
  Physical Curve(Sprintf("pellet_%g_side", k)) = {c + 3};
  axis[] += c + 7;
  low[] = {c + 1}; high[] = {c + 5};
  If (whole_faces)
    low[] += c; high[] += c + 6;
  EndIf
  If (k == 0)
    Physical Curve("bottom") = {low[]};
  Else
    Physical Curve(Sprintf("pellet_%g_bottom", k)) = {low[]};
  EndIf
  If (k == pellets - 1)
    Physical Curve("top") = {high[]};
  Else
    Physical Curve(Sprintf("pellet_%g_top", k)) = {high[]};
  EndIf
EndFor
Physical Curve("axis") = {axis[]};

inner = radius + gap; outer = inner + thickness; top = pellets * height;
p = newp;
Point(p) = {inner, 0, 0}; Point(p + 1) = {outer, 0, 0}; Point(p + 2) = {outer, top, 0}; Point(p + 3) = {inner, top, 0};
c = newl;
Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Line(c + 3) = {p + 3, p};
s = news;
Curve Loop(s) = {c : c + 3};
Plane Surface(s) = {s};
Transfinite Curve{c, c + 2} = 3;
Transfinite Curve{c + 1, c + 3} = 7 * n * pellets / 2 + 1;
Transfinite Surface{s};
If (kind == 0)
  Recombine Surface{s};
EndIf
Physical Surface("cladding") = {s};
Physical Curve("foot") = {c};
Physical Curve("outside") = {c + 1};
Physical Curve("inside") = {c + 3};
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
