// A stamp whose underside is a circle of radius 1.5 above (2, 2), cut into columns of the same width.
DefineConstant[ f = {1, Name "refinement"} ];
n = 8 * f;
radius = 1.5;
For k In {0:n}
  x = -1 + 2 * k / n;
  Point(1 + k) = {2 + x, 2 + radius - Sqrt(radius * radius - x * x), 0, 1};
EndFor
Point(n + 2) = {3, 3.5, 0, 1};
Point(n + 3) = {1, 3.5, 0, 1};
For k In {1:n}
  Line(k) = {k, k + 1};
  Transfinite Curve {k} = 2;
EndFor
Line(n + 1) = {n + 1, n + 2};
Line(n + 2) = {n + 2, n + 3};
Line(n + 3) = {n + 3, 1};
Transfinite Curve {n + 1, n + 3} = 5 * f + 1;
Transfinite Curve {n + 2} = n + 1;
Curve Loop(1) = {1:(n + 3)};
Plane Surface(1) = {1};
Transfinite Surface {1} = {1, n + 1, n + 2, n + 3};
Recombine Surface {1};
Physical Curve("round") = {1:n};
Physical Curve("right") = {n + 1};
Physical Curve("top") = {n + 2};
Physical Curve("left") = {n + 3};
Physical Surface("stamp") = {1};
