// A roller bearing: rollers of radius 5 between two rings of thickness 10, lengths in mm.
// Bodies "inner", "outer", "roller_NUMBER"; curves "bore", "rim", "inner_race", "outer_race", "roller_NUMBER_in" and
// "roller_NUMBER_out", the halves towards the rings. A roller stands at the lowest place.
DefineConstant[
  rollers = {12, Name "rollers"},
  pitch = {35, Name "radius of the circle of their centres"},
  fine = {0.04, Name "edges where rollers touch rings"},
  coarse = {3, Name "edges elsewhere"},
  order = {2, Name "order of the elements"},
  straight = {0, Name "second-order nodes on 0: the circles, 1: straight edges"}
];

o = newp;
Point(o) = {0, 0, 0};
ring[] = {};
touching[] = {};

// A ring of arcs that end at the rollers' angles: its points, then its arcs into ring[].
Macro Ring
  first = newp;
  ring[] = {};
  For k In {0 : rollers - 1}
    a = 2 * Pi * k / rollers - Pi / 2;
    Point(first + k) = {r * Cos(a), r * Sin(a), 0};
  EndFor
  For k In {0 : rollers - 1}
    c = newl;
    Circle(c) = {first + k, o, first + (k + 1) % rollers};
    ring[] += c;
  EndFor
Return

r = pitch - 15;
Call Ring;
bore[] = ring[];
r = pitch - 5;
Call Ring;
inner[] = ring[];
touching[] += {first : first + rollers - 1};
r = pitch + 5;
Call Ring;
outer[] = ring[];
touching[] += {first : first + rollers - 1};
r = pitch + 15;
Call Ring;
rim[] = ring[];
// Edges of `fine` along six of them to both sides of where a roller touches, then longer by three tenths of the way.
Field[1] = Distance;
Field[1].PointsList = {touching[]};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = fine;
Field[2].SizeMax = coarse;
Field[2].DistMin = 6 * fine;
Field[2].DistMax = 6 * fine + (coarse - fine) / 0.3;
Background Field = 2;
s = news;
Curve Loop(s) = {inner[]}; Curve Loop(s + 1) = {bore[]};
Plane Surface(s) = {s, s + 1};
Curve Loop(s + 2) = {rim[]}; Curve Loop(s + 3) = {outer[]};
Plane Surface(s + 2) = {s + 2, s + 3};
Physical Surface("inner") = {s};
Physical Surface("outer") = {s + 2};
Physical Curve("bore") = {bore[]};
Physical Curve("inner_race") = {inner[]};
Physical Curve("outer_race") = {outer[]};
Physical Curve("rim") = {rim[]};

For k In {0 : rollers - 1}
  a = 2 * Pi * k / rollers - Pi / 2;
  x = pitch * Cos(a); y = pitch * Sin(a); u = 5 * Cos(a); v = 5 * Sin(a);
  p = newp;
  Point(p) = {x, y, 0};
  Point(p + 1) = {x + u, y + v, 0};
  Point(p + 2) = {x - v, y + u, 0};
  Point(p + 3) = {x - u, y - v, 0};
  Point(p + 4) = {x + v, y - u, 0};
  c = newl;
  Circle(c) = {p + 1, p, p + 2}; Circle(c + 1) = {p + 2, p, p + 3};
  Circle(c + 2) = {p + 3, p, p + 4}; Circle(c + 3) = {p + 4, p, p + 1};
  s = news;
  Curve Loop(s) = {c : c + 3};
  Plane Surface(s) = {s};
  Physical Surface(Sprintf("roller_%g", k)) = {s};
  Physical Curve(Sprintf("roller_%g_in", k)) = {c + 1, c + 2};
  Physical Curve(Sprintf("roller_%g_out", k)) = {c + 3, c};
EndFor
Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
Mesh.SecondOrderLinear = straight;
Mesh.MeshSizeExtendFromBoundary = 0;
