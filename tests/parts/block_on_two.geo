// A block on two adjacent ones, all of them in contact at the upper end of the joint.
DefineConstant[ bottom = 0.3, top = 0.55 ]; // x of the joint's ends
Point(1) = {0, 0, 0}; Point(2) = {bottom, 0, 0}; Point(3) = {top, 0.6, 0}; Point(4) = {0, 0.6, 0};
Point(5) = {bottom, 0, 0}; Point(6) = {1.2, 0, 0}; Point(7) = {1.2, 0.6, 0}; Point(8) = {top, 0.6, 0};
Point(9) = {0, 0.6, 0}; Point(10) = {top, 0.6, 0}; Point(11) = {1.2, 0.6, 0}; Point(12) = {1.2, 1.1, 0}; Point(13) = {0, 1.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Line(9) = {9, 10}; Line(10) = {10, 11}; Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 9};
Curve Loop(1) = {1 ... 4}; Plane Surface(1) = {1}; Physical Surface("left") = {1};
Curve Loop(2) = {5 ... 8}; Plane Surface(2) = {2}; Physical Surface("right") = {2};
Curve Loop(3) = {9 ... 13}; Plane Surface(3) = {3}; Physical Surface("block") = {3};
Physical Curve("bottom") = {1, 5}; Physical Curve("wall") = {4, 13}; Physical Curve("pushed") = {6}; Physical Curve("top") = {12};
Physical Curve("joint_left") = {2}; Physical Curve("joint_right") = {8};
Physical Curve("on_left") = {3}; Physical Curve("foot_left") = {9};
Physical Curve("on_right") = {7}; Physical Curve("foot_right") = {10};
