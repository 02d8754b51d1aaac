// A ring drawn with an interference on another: quarters.
DefineConstant[ n = 12, interference = 0.001 ];  // elements on a quarter circle
r[] = {1, 2 + interference, 2, 3};
For i In {0 : 1}
  h = Pi / n * (1 - 0.2 * i);
  a = r[2 * i];
  b = r[2 * i + 1];
  p = newp;
  Point(p) = {0, 0, 0};
  Point(p + 1) = {a, 0, 0, h};
  Point(p + 2) = {b, 0, 0, h};
  Point(p + 3) = {0, b, 0, h};
  Point(p + 4) = {0, a, 0, h};
  c = newc;
  Line(c) = {p + 1, p + 2};
  Circle(c + 1) = {p + 2, p, p + 3};
  Line(c + 2) = {p + 3, p + 4};
  Circle(c + 3) = {p + 4, p, p + 1};
  Curve Loop(c + 4) = {c : c + 3};
  Plane Surface(i + 1) = {c + 4};
  cut_x[] += {c};
  cut_y[] += {c + 2};
  contact[] += {c + 1 + 2 * i};
EndFor
Physical Surface("inner") = {1};
Physical Surface("outer") = {2};
Physical Curve("cut_x") = cut_x[];
Physical Curve("cut_y") = cut_y[];
Physical Curve("inner_contact") = {contact[0]};
Physical Curve("outer_contact") = {contact[1]};
Mesh.ElementOrder = 2;
