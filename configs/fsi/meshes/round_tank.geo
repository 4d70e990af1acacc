// A cylinder, around z, of hexahedra: a square core and four blocks around it.
DefineConstant[
  radius = 0.55, bottom = -0.61, top = 0.14,
  n = 8,       // cells along an edge of the core
  m = 8,       // cells from the core to the wall
  layers = 16  // cells along the axis
];
core = 0.5*radius;  // distance of the core's corners from the axis
Point(1) = {0, 0, bottom};
For k In {0:3}
  angle = Pi/4 + k*Pi/2;
  Point(10 + k) = {core*Cos(angle), core*Sin(angle), bottom};
  Point(20 + k) = {radius*Cos(angle), radius*Sin(angle), bottom};
EndFor
For k In {0:3}
  Line(10 + k) = {10 + k, 10 + (k + 1)%4};
  Circle(20 + k) = {20 + k, 1, 20 + (k + 1)%4};
  Line(30 + k) = {10 + k, 20 + k};
  Transfinite Curve{10 + k, 20 + k} = n + 1;
  Transfinite Curve{30 + k} = m + 1;
EndFor
Curve Loop(1) = {10:13};
Plane Surface(1) = {1};
For k In {0:3}
  Curve Loop(2 + k) = {30 + k, 20 + k, -(30 + (k + 1)%4), -(10 + k)};
  Plane Surface(2 + k) = {2 + k};
EndFor
Transfinite Surface{1:5};
Recombine Surface{1:5};

volumes[] = {};
ends[] = {};
wall[] = {};
For k In {1:5}
  out[] = Extrude {0, 0, top - bottom} { Surface{k}; Layers{layers}; Recombine; };
  ends[] += out[0];
  volumes[] += out[1];
  If (k > 1)
    wall[] += out[3];
  EndIf
EndFor
Physical Surface("bottom") = {1:5};
Physical Surface("top") = {ends[]};
Physical Surface("wall") = {wall[]};
Physical Volume("tank") = {volumes[]};
