// A stamp on a plate, carried by a bent leaf spring.
DefineConstant[ h = 0.02 ];  // edge of a cell
bottom = -0.61; thickness = 0.07; top = 0.57;
swing = 0.2;  // of the spring to either side
half = 0.03;  // of its thickness
n = 24;

// The spring's two sides, from the plate down.
For k In {0:n}
  s = k/n;
  x = swing*Sin(2*Pi*s);
  slope = swing*2*Pi*Cos(2*Pi*s)/bottom;
  // The sides start and end at the heights of plate and floor.
  w = half*Sqrt(1 + slope^2);
  Point(100 + k) = {x - w, bottom*s, 0};
  Point(200 + k) = {x + w, bottom*s, 0};
EndFor
Point(1) = {-0.5, 0, 0};
Point(2) = {0.5, 0, 0};
Point(3) = {0.5, thickness, 0};
Point(4) = {0.15, thickness, 0};
Point(5) = {0.15, top, 0};
Point(6) = {-0.15, top, 0};
Point(7) = {-0.15, thickness, 0};
Point(8) = {-0.5, thickness, 0};
Spline(1) = {100:100 + n};
Line(2) = {100 + n, 200 + n};
Spline(3) = {200:200 + n};
Line(4) = {200, 2};
Line(5) = {2, 3};
Line(6) = {3, 4};
Line(7) = {4, 5};
Line(8) = {5, 6};
Line(9) = {6, 7};
Line(10) = {7, 8};
Line(11) = {8, 1};
Line(12) = {1, 100};
Line(13) = {200, 100};
Curve Loop(1) = {1, 2, -3, 13};
Curve Loop(2) = {4:12, -13};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 3} = Ceil(1.2/h) + 1;
Transfinite Curve{2, 13} = 3;
Transfinite Surface{1};
Recombine Surface{1, 2};
Physical Curve("bottom") = {2};
Physical Curve("top") = {8};
Physical Surface("damper") = {1, 2};
// Recombination halves what it is given.
Mesh.CharacteristicLengthMin = 2*h;
Mesh.CharacteristicLengthMax = 2*h;
Mesh.Algorithm = 5;
Mesh.RecombinationAlgorithm = 2;  // quadrilaterals only
