// An axisymmetric punch, flat up to x = flat, then rounded with the radius fillet, on a foundation whose top is y = 0; curves
// "foot", "top", "surface", "base". n: elements along the flat.
DefineConstant[ n = 10, flat = 40, fillet = 10, height = 100, radius = 100, depth = 200 ];
h = flat / n;
Point(1) = {0, 0, 0, h}; Point(2) = {flat, 0, 0, h / 8}; Point(3) = {flat + fillet, fillet, 0, h};
Point(4) = {flat + fillet, height, 0, height / 4}; Point(5) = {0, height, 0, height / 4}; Point(6) = {flat, fillet, 0};
Line(1) = {1, 2}; Circle(2) = {2, 6, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1};
Physical Surface("punch") = {1}; Physical Curve("foot") = {1, 2}; Physical Curve("top") = {4};
Point(11) = {0, 0, 0, h}; Point(12) = {flat, 0, 0, h / 10}; Point(13) = {radius, 0, 0, radius / 4};
Point(14) = {radius, -depth, 0, radius / 4}; Point(15) = {0, -depth, 0, radius / 4};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(2) = {11 : 15}; Plane Surface(2) = {2};
Physical Surface("foundation") = {2}; Physical Curve("surface") = {11, 12}; Physical Curve("base") = {14};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
