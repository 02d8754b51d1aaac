// Half of a block on half of a wider one, in contact on x < 1.
DefineConstant[ n = 4 ];
h = 1 / n;
Point(1) = {0, 0, 0, h}; Point(2) = {2, 0, 0, h}; Point(3) = {2, 1, 0, h}; Point(4) = {1, 1, 0, h}; Point(5) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1};
h = 0.7 / n;
Point(6) = {0, 1, 0, h}; Point(7) = {1, 1, 0, h}; Point(8) = {1, 2, 0, h}; Point(9) = {0, 2, 0, h};
Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 6};
Curve Loop(2) = {6 : 9}; Plane Surface(2) = {2};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("ground") = {1}; Physical Curve("rest") = {3}; Physical Curve("lower_contact") = {4};
Physical Curve("upper_contact") = {6}; Physical Curve("head") = {8}; Physical Curve("axis") = {5, 9};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
