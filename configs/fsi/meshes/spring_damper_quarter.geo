// A quarter of a stamp on a disc with two holes, carried by two straight columns; after thesis 3.6.
DefineConstant[ h = 0.05 ];  // edge of a cell
bottom = -0.61; thickness = 0.07; top = 0.57;

Point(1) = {0, 0, 0};
Point(2) = {0.3, 0, 0};
Point(3) = {0, 0.3, 0};
x[] = {0.15, 0.2, 0.4, 0.5};
y[] = {0.15, 0.23, 0.37, 0.5};
For k In {0:3}
  Point(10 + k) = {x[k], 0, 0};
  Point(20 + k) = {0, y[k], 0};
EndFor
Point(4) = {0.3, 0.1, 0};
Point(5) = {0.07, 0.3, 0};
Line(1) = {1, 10};
Line(2) = {10, 11};
Circle(3) = {11, 2, 4};
Circle(4) = {4, 2, 12};
Line(5) = {12, 13};
Circle(6) = {13, 1, 23};
Line(7) = {23, 22};
Circle(8) = {22, 3, 5};
Circle(9) = {5, 3, 21};
Line(10) = {21, 20};
Line(11) = {20, 1};
Circle(12) = {10, 1, 20};
Line(13) = {22, 21};
Curve Loop(1) = {1, 12, 11};
Curve Loop(2) = {8, 9, -13};
Curve Loop(3) = {2:10, -12};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Recombine Surface{1:3};

volumes[] = {};
For s In {1:3}
  out[] = Extrude {0, 0, thickness} { Surface{s}; Layers{Ceil(thickness/h)}; Recombine; };
  volumes[] += out[1];
  If (s == 1)
    out[] = Extrude {0, 0, top - thickness} { Surface{out[0]}; Layers{Ceil((top - thickness)/h)}; Recombine; };
    volumes[] += out[1];
    Physical Surface("top") = {out[0]};
  EndIf
EndFor
out[] = Extrude {0, 0, bottom} { Surface{2}; Layers{Ceil(-bottom/h)}; Recombine; };
volumes[] += out[1];
Physical Surface("bottom") = {out[0]};
Physical Volume("damper") = {volumes[]};
// Recombination halves what it is given.
Mesh.CharacteristicLengthMin = 2*h;
Mesh.CharacteristicLengthMax = 2*h;
Mesh.Algorithm = 5;
Mesh.RecombinationAlgorithm = 2;  // quadrilaterals only
