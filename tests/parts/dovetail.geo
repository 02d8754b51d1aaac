// A tenon drawn up against the two flanks of its slot: the right half, the flank at 60 degrees.
DefineConstant[ n = 12 ];  // elements on a flank
SetFactory("OpenCASCADE");
height = 0.04;
slope = height / Tan(Pi / 3);
h = height / Sin(Pi / 3) / n;
Point(1) = {0, 0, 0, h};
Point(2) = {0.05, 0, 0, h};
Point(3) = {0.05 - slope, height, 0, h};
Point(4) = {0.05 - slope, 0.1, 0, 2 * h};
Point(5) = {0, 0.1, 0, 2 * h};
Point(11) = {0.05, 0, 0, 0.8 * h};
Point(12) = {0.05, -0.005, 0, 0.8 * h};
Point(13) = {0.05, -0.05, 0, 2 * h};
Point(14) = {0.15, -0.05, 0, 2 * h};
Point(15) = {0.15, height, 0, 2 * h};
Point(16) = {0.05 - slope, height, 0, 0.8 * h};
For i In {1 : 5}
  Line(i) = {i, i % 5 + 1};
EndFor
For i In {11 : 16}
  Line(i) = {i, i == 16 ? 11 : i + 1};
EndFor
Curve Loop(1) = {1 : 5};
Plane Surface(1) = {1};
Curve Loop(2) = {11 : 16};
Plane Surface(2) = {2};
Physical Surface("tenon") = {1};
Physical Surface("slot") = {2};
Physical Curve("axis") = {5};
Physical Curve("pulled") = {4};
Physical Curve("base") = {13};
Physical Curve("wall") = {14};
Physical Curve("tenon_flank") = {2};
Physical Curve("slot_flank") = {16};
Mesh.ElementOrder = 2;
