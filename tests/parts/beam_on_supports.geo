// A beam on three supports: a foot of its own for each of them, which reaches beyond the support.
DefineConstant[ n = 4 ];  // elements on a support's width
SetFactory("OpenCASCADE");
h = 0.02 / n;
p = newp;
x[] = {0, 0.3, 0.7, 1};
For i In {0 : 3}
  Point(p + i) = {x[i], 0, 0, 2.5 * h};
EndFor
Point(p + 4) = {1, 0.1, 0, 0.02};
Point(p + 5) = {0, 0.1, 0, 0.02};
For i In {0 : 4}
  Line(1 + i) = {p + i, p + i + 1};
EndFor
Line(6) = {p + 5, p};
Curve Loop(1) = {1 : 6};
Plane Surface(1) = {1};
For i In {0 : 2}
  Rectangle(2 + i) = {0.04 + 0.45 * i, -0.04, 0, 0.02, 0.04};
  MeshSize { PointsOf { Surface{2 + i}; } } = h;
EndFor
Physical Surface("beam") = {1};
Physical Surface("supports") = {2 : 4};
Physical Curve("beam_side") = {6};
Physical Curve("beam_top") = {5};
Physical Curve("ground") = {7, 11, 15};
For i In {0 : 2}
  Physical Curve(Sprintf("foot_%g", i)) = {1 + i};
  Physical Curve(Sprintf("head_%g", i)) = {9 + 4 * i};
EndFor
Mesh.ElementOrder = 2;
