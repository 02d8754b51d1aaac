// Motions that no closed row holds: those that a load drives, and how far they go.
#pragma once

#include "solve/contact_rows.hpp"

namespace mortise {

/// s: motions that open no row to below zero and on which the load works, by least squares of its balance: where there
/// are any, no pressures on the rows carry the load (Farkas' lemma, docs/theory.md eq. 27c). Zero where there are none.
VecX driven_motions(const ContactRows& rows);

/// s: the least motions (of the springs' unknowns) that differ from `at` by `free` ones (s x count, independent) and
/// leave all rows open whose gap at `at` is w (m) and which are not closed (Lawson & Hanson 1974, chapter 23: least
/// distance programming).
VecX least_motions(const ContactRows& rows, const VecX& at, const MatX& free, const VecX& w,
                   const std::vector<char>& closed);

}  // namespace mortise
