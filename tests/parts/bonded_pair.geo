// A strip of two materials that share their nodes, on a block.
DefineConstant[ n = 10 ];  // elements on the strip's width
h = 1 / n;
Point(1) = {0, 0.5, 0, h};
Point(2) = {1, 0.5, 0, h};
Point(3) = {1, 0.7, 0, h};
Point(4) = {0, 0.7, 0, h};
Point(5) = {1, 0.9, 0, h};
Point(6) = {0, 0.9, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(2) = {2};
Point(11) = {0, 0, 0, 0.8 * h};
Point(12) = {1, 0, 0, 0.8 * h};
Point(13) = {1, 0.5, 0, 0.8 * h};
Point(14) = {0, 0.5, 0, 0.8 * h};
For i In {11 : 14}
  Line(i) = {i, i == 14 ? 11 : i + 1};
EndFor
Curve Loop(3) = {11 : 14};
Plane Surface(3) = {3};
Physical Surface("lining") = {1};
Physical Surface("back") = {2};
Physical Surface("block") = {3};
Physical Curve("lining_foot") = {1};
Physical Curve("block_top") = {13};
Physical Curve("head") = {6};
Physical Curve("ground") = {11};
Physical Curve("sides") = {2, 4, 5, 7, 12, 14};
Mesh.ElementOrder = 2;
