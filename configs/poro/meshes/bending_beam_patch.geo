// The fluid around the beam of bending_beam.geo in layers, whose inner nodes are those of the beam's surface.
DefineConstant[
  width = 0.12,   // of the stem
  radius = 0.12,  // of the tip
  h = 0.015,      // size of the beam's cells
  thick = 0.05,   // of all layers
  layers = 5
];
x = 0.75;
For k In {0:1}
  // k = 0: the beam's surface, k = 1: the patch's edge
  half = width/2 + k*thick;
  r = radius + k*thick;
  joint = 0.5 - Sqrt(r^2 - half^2);
  p = 10*k;
  If(k == 0)
    Point(100) = {x, 0.5, 0};
  EndIf
  Point(p + 1) = {x - half, 0, 0};
  Point(p + 2) = {x - half, joint, 0};
  Point(p + 3) = {x - r, 0.5, 0};
  Point(p + 4) = {x, 0.5 + r, 0};
  Point(p + 5) = {x + r, 0.5, 0};
  Point(p + 6) = {x + half, joint, 0};
  Point(p + 7) = {x + half, 0, 0};
  Line(p + 1) = {p + 1, p + 2};
  Circle(p + 2) = {p + 2, 100, p + 3};
  Circle(p + 3) = {p + 3, 100, p + 4};
  Circle(p + 4) = {p + 4, 100, p + 5};
  Circle(p + 5) = {p + 5, 100, p + 6};
  Line(p + 6) = {p + 6, p + 7};
EndFor
stem = Round((0.5 - Sqrt(radius^2 - width^2/4))/h);
shoulder = Round(radius*Acos(width/2/radius)/h);
tip = Round(radius*Pi/2/h);
Transfinite Curve{1, 6, 11, 16} = stem + 1;
Transfinite Curve{2, 5, 12, 15} = shoulder + 1;
Transfinite Curve{3, 4, 13, 14} = tip + 1;
For i In {1:7}
  Line(20 + i) = {i, 10 + i};
EndFor
Transfinite Curve{21:27} = layers + 1;
For i In {1:6}
  Curve Loop(i) = {i, 21 + i, -(10 + i), -(20 + i)};
  Plane Surface(i) = {i};
  Transfinite Surface{i};
EndFor
Recombine Surface{:};
Physical Curve("wet") = {1:6};
Physical Curve("edge") = {11:16};
Physical Curve("feet") = {21, 27};
Physical Surface("patch") = {1:6};
