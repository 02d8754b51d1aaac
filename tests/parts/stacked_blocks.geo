// Two blocks of one width, one upon the other.
DefineConstant[ n = 8 ];  // elements on the upper block's width
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Rectangle(2) = {0, 1, 0, 1, 1};
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("ground") = {1};
Physical Curve("lower_top") = {3};
Physical Curve("upper_foot") = {5};
MeshSize { PointsOf { Surface{1}; } } = 0.8 / n;
MeshSize { PointsOf { Surface{2}; } } = 1 / n;
Mesh.ElementOrder = 2;
