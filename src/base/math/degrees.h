// Trigonometric functions in degrees, exact where the result is a simple fraction: sine(30) is 0.5.
#pragma once

namespace ombre::degrees {

// All return NaN for arguments that are not finite.
double sine(double angle);
double cosine(double angle);
double tangent(double angle);
double arc_sine(double x);
double arc_cosine(double x);
double arc_tangent(double x);
double arc_tangent2(double y, double x);

}  // namespace ombre::degrees
