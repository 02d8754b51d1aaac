// A block in an inner corner, pressed against floor and wall at once: the contact line has a kink.
DefineConstant[ n = 10 ];  // elements on a side of the block
SetFactory("OpenCASCADE");
h = 0.1 / n;
Rectangle(1) = {0, 0, 0, 0.1, 0.1};
Point(11) = {0, 0.2, 0, 0.8 * h};
Point(12) = {0, 0, 0, 0.8 * h};
Point(13) = {0.2, 0, 0, 0.8 * h};
Point(14) = {0.2, -0.1, 0, 2 * h};
Point(15) = {-0.1, -0.1, 0, 2 * h};
Point(16) = {-0.1, 0.2, 0, 2 * h};
For i In {11 : 16}
  Line(i) = {i, i == 16 ? 11 : i + 1};
EndFor
Curve Loop(2) = {11 : 16};
Plane Surface(2) = {2};
Physical Surface("block") = {1};
Physical Surface("angle") = {2};
Physical Curve("block_sides") = {1, 4};
Physical Curve("block_top") = {3};
Physical Curve("block_right") = {2};
Physical Curve("angle_sides") = {11, 12};
Physical Curve("ground") = {14};
MeshSize { PointsOf { Surface{1}; } } = h;
Mesh.ElementOrder = 2;
