// Points where p goes as a small power of the distance, to zero or without limit: no mesh shows it.
#pragma once

#include <vector>

#include "contact/singular_points.hpp"
#include "error/pressure_line.hpp"

namespace mortise {

/// Where a free face meets the contact line at other than a right angle p is zero at the very end, and c r^d at a
/// distance r from it; where rollers do it grows so, d < 0 (SingularPoint::small_power). Of a small d p is as good as
/// constant a little further on: slopes between vertices show nothing. Takes such points from the list, which leaves
/// nothing out around them, and adds to `error` what hats miss of r^d (docs/theory.md eq. 47b). Those that are loaded.
std::vector<SingularPoint> add_weak_points(const PressureLine& line, std::vector<SingularPoint>& points,
                                           LineError& error);

/// By which part of itself r^d differs between an edge's length and a place that counts as the point.
double weak_change(double d);

/// The same where p = p0 +- amplitude ln r on both sides of a place, stress.
void add_weak_logarithm(const PressureLine& line, const Vec2& place, double amplitude, LineError& error);

/// The same where contact gives way as `law` says. The layer rounds off what p of closed contact does at any such
/// point, r^d or its limit A ln r, within a length E* / k, k the law's slope: p there is off by no more than from an
/// edge's length down to that. On edges shorter than it the bodies' stresses still go as d p ln r, as at closed
/// contact, and the overlap as d p r ln r / E*. `modulus`: E*.
void add_layer_ends(const PressureLine& line, const std::vector<SingularPoint>& points, const ContactLaw& law,
                    double modulus, LineError& error);

/// Where an edge of the multiplier side faces a fillet of radius r less than its length h, p may grow towards it as at
/// a sharp corner, at most as p sqrt(h / s) at s from h down to r, and the edge shows nothing of it (docs/theory.md eq.
/// 47d). 1 / r: of both sides together, as these may follow each other. Such places are narrow ones, for edges of r.
/// None where the scene gives the gap: it is that of no drawn fillet.
void add_hidden_fillets(const Points& nodes, const ContactPair& pair, const PressureLine& line, LineError& error);

}  // namespace mortise
