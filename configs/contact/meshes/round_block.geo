// Half of a block, 6 wide and high, whose underside is a circle of radius 8 that touches y = 0: columns as wide as `fine` over `reach`, then
// ever wider ones, and rows that grow likewise.
DefineConstant[ fine = {0.0085, Name "cell at the contact"}, reach = {0.136, Name "of the fine cells"}, grow = {1.1, Name "of the cells, from one to the next"} ];
half = 6;
radius = 8;
n = Round(reach/fine);
m = Ceil(Log(1 + (half - reach)/fine*(grow - 1)/grow)/Log(grow));  // wider columns
rows = Ceil(Log(1 + half/fine*(grow - 1))/Log(grow));
scale = (half - reach)*(grow - 1)/(grow*(grow^m - 1));
For k In {0:n + m}
  x = (k <= n) ? reach*k/n : reach + scale*grow*(grow^(k - n) - 1)/(grow - 1);
  Point(1 + k) = {x, radius - Sqrt(radius*radius - x*x), 0};
  Point(10001 + k) = {x, half, 0};
EndFor
For k In {1:n + m}
  Line(k) = {k, k + 1};
  Line(10000 + k) = {10000 + k, 10001 + k};
  Transfinite Curve {k, 10000 + k} = 2;
EndFor
Line(20001) = {1, 10001};
Line(20002) = {n + m + 1, 10001 + n + m};
Transfinite Curve {20001, 20002} = rows + 1 Using Progression grow;
Curve Loop(1) = {1:n + m, 20002, -(10000 + n + m):-10001, -20001};
Plane Surface(1) = {1};
Transfinite Surface {1} = {1, n + m + 1, 10001 + n + m, 10001};
Recombine Surface {1};
Physical Curve("axis") = {20001};
Physical Curve("round") = {1:n + m};
Physical Curve("side") = {20002};
Physical Curve("top") = {10001:10000 + n + m};
Physical Surface("block") = {1};
