// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "sdf/distance_field.h"

namespace exemplar {

/// Whether a solid that ends at both sides of its field's box across an axis, with no air between,
/// is a piece of something longer: a wall's ends look as if it had been cut there, a heap's and a
/// column's do not. At both ends
///  - the slab of two samples holds at least three fifths of what three quarters of all slabs hold
///    at most (round things have little there);
///  - what is solid at the very end and further in is half the same, in the mean over the first
///    quarter of the length: half of whichever is less, as of the rails between a fence's posts (a
///    ring is elsewhere);
/// and of what is solid at one end or the other, at least half is at both (an L has an arm across
/// one of them). False for fields of
/// fewer than four samples along the axis. O(n) for n samples.
bool looksCut(const DistanceField& field, int axis);

}  // namespace exemplar
