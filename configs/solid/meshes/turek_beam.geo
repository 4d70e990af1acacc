// The elastic beam of Turek and Hron (2006): 0.35 x 0.02 behind a cylinder of radius 0.05 at (0.2, 0.2).
//   gmsh -2 -format msh41 turek_beam.geo
SetFactory("Built-in");
nx = 48;  // cells along the beam
ny = 4;   // cells across, even so that the point A = (0.6, 0.2) is a node
x0 = 0.2 + Sqrt(0.05^2 - 0.01^2);
Point(1) = {0.2, 0.2, 0};
Point(2) = {x0, 0.19, 0};
Point(3) = {0.6, 0.19, 0};
Point(4) = {0.6, 0.21, 0};
Point(5) = {x0, 0.21, 0};
Line(1) = {2, 3};
Line(2) = {3, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, -3} = nx + 1 Using Progression 1.02;
Transfinite Curve{2, 4} = ny + 1;
Transfinite Surface{1};
Recombine Surface{1};
Physical Curve("clamped") = {4};
Physical Curve("tip") = {2};
Physical Curve("sides") = {1, 3};
Physical Surface("beam") = {1};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;
