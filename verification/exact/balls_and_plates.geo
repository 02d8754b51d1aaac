// Axisymmetric, from below: "plate" of radius 20 and thickness 4, "ball" of radius 10, "small" of radius 5, "lid" of radius
// 10 and thickness 2, each on the one before; curves NAME_above and NAME_below where they touch, "rim" of the plate, "head".
DefineConstant[ n = 10 ];
Macro Ball  // of radius r about y
  p = newp; h = r / n;
  Point(p) = {0, y - r, 0, h}; Point(p + 1) = {r, y, 0, h}; Point(p + 2) = {0, y + r, 0, h}; Point(p + 3) = {0, y, 0, h};
  c = newc;
  Circle(c) = {p, p + 3, p + 1}; Circle(c + 1) = {p + 1, p + 3, p + 2}; Line(c + 2) = {p + 2, p};
  s = news; Curve Loop(s) = {c : c + 2}; Plane Surface(s) = {s};
Return
Macro Plate  // of radius r, from y to y + t
  p = newp; h = r / n;
  Point(p) = {0, y, 0, h}; Point(p + 1) = {r, y, 0, h}; Point(p + 2) = {r, y + t, 0, h}; Point(p + 3) = {0, y + t, 0, h};
  c = newc;
  Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 3}; Line(c + 3) = {p + 3, p};
  s = news; Curve Loop(s) = {c : c + 3}; Plane Surface(s) = {s};
Return
r = 20; y = 0; t = 4; Call Plate;
Physical Surface("plate") = {s}; Physical Curve("plate_above") = {c + 2}; Physical Curve("rim") = {c + 1};
r = 10; y = 14; Call Ball;
Physical Surface("ball") = {s}; Physical Curve("ball_below") = {c}; Physical Curve("ball_above") = {c + 1};
r = 5; y = 29; Call Ball;
Physical Surface("small") = {s}; Physical Curve("small_below") = {c}; Physical Curve("small_above") = {c + 1};
r = 10; y = 34; t = 2; Call Plate;
Physical Surface("lid") = {s}; Physical Curve("lid_below") = {c}; Physical Curve("head") = {c + 2};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
