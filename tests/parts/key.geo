// A key in the keyways of a shaft and a hub, which it clears by c at its sides. Lengths in mm.
SetFactory("OpenCASCADE");
DefineConstant[ R = 30, b = 14, h = 10, depth = 6, c = 0.01, fillet = 0.5, size = 3 ];
Disk(1) = {0, 0, 0, R};
Rectangle(2) = {-b/2, R - depth, 0, b, h};
Disk(3) = {0, 0, 0, 0.3*R};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
Disk(5) = {0, 0, 0, 2*R};
Disk(6) = {0, 0, 0, R + c};
Rectangle(7) = {-b/2 - c, 0, 0, b + 2*c, R - depth + h + 10*c};
BooleanDifference(8) = { Surface{5}; Delete; }{ Surface{6, 7}; Delete; };
Rectangle(9) = {-b/2, R - depth, 0, b, h, fillet};
Physical Surface("shaft") = {4};
Physical Surface("hub") = {8};
Physical Surface("key") = {9};
Physical Curve("key_side") = Abs(Boundary{ Surface{9}; });
of_shaft() = Abs(Boundary{ Surface{4}; });
of_hub() = Abs(Boundary{ Surface{8}; });
bore() = {}; outside() = {};
For k In {0:#of_shaft()-1}
  box() = BoundingBox Curve{ of_shaft(k) };
  If (box(4) < 0.31*R)
    bore() += of_shaft(k);
  EndIf
EndFor
For k In {0:#of_hub()-1}
  box() = BoundingBox Curve{ of_hub(k) };
  If (box(4) > 1.9*R)
    outside() += of_hub(k);
  EndIf
EndFor
of_shaft() -= bore();
of_hub() -= outside();
Physical Curve("bore") = bore();
Physical Curve("outside") = outside();
Physical Curve("shaft_side") = of_shaft();
Physical Curve("hub_side") = of_hub();
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.ElementOrder = 2;
