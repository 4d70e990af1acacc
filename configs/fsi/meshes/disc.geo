// A disc of radius 0.25 about (0.5, 0.5): a core of n x n cells and four blocks of n x m between it and the circle.
//   gmsh -2 -format msh41 disc.geo -setnumber n 3  -setnumber m 3  -o disc_45.msh
//   gmsh -2 -format msh41 disc.geo -setnumber n 8  -setnumber m 6  -o disc_256.msh
SetFactory("Built-in");
DefineConstant[ n = 3, m = 3 ];
r = 0.25;
a = 0.5 * r / Sqrt(2);  // the core's corners lie half way out
b = 0.42 * r;           // and its sides bulge
s = r / Sqrt(2);
Point(1) = {0.5, 0.5, 0};
For i In {0 : 3}
  c = Cos(i * Pi / 2);
  d = Sin(i * Pi / 2);
  Point(10 + i) = {0.5 + c * a - d * a, 0.5 + d * a + c * a, 0};
  Point(20 + i) = {0.5 + c * s - d * s, 0.5 + d * s + c * s, 0};
  Point(30 + i) = {0.5 - d * (2 * b - a), 0.5 + c * (2 * b - a), 0};
EndFor
For i In {0 : 3}
  j = (i + 1) % 4;
  Bezier(10 + i) = {10 + i, 30 + i, 10 + j};
  Circle(20 + i) = {20 + i, 1, 20 + j};
  Line(30 + i) = {10 + i, 20 + i};
EndFor
Transfinite Curve{10, 11, 12, 13, 20, 21, 22, 23} = n + 1;
Transfinite Curve{30, 31, 32, 33} = m + 1;
Curve Loop(1) = {10, 11, 12, 13};
Plane Surface(1) = {1};
For i In {0 : 3}
  j = (i + 1) % 4;
  Curve Loop(2 + i) = {30 + i, 20 + i, -(30 + j), -(10 + i)};
  Plane Surface(2 + i) = {2 + i};
EndFor
Transfinite Surface{1 : 5};
Recombine Surface{1 : 5};
Physical Surface("disc") = {1 : 5};
Physical Curve("surface") = {20, 21, 22, 23};
