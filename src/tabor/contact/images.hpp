#pragma once

#include <optional>

#include "tabor/contact/contact.hpp"

// Solves the contact of a map of mirror images on one of them.
namespace tabor::contact {

/// Returns the problem on the first of 2 x 2 mirror images; nothing where the heights or the bounds
/// are no such images. Its solution is that of the whole map, by symmetry: a convex problem has one
/// solution, which the images share.
std::optional<Problem> problem_of_image(const Problem& problem);

/// Returns the state of the whole map from that of its first quarter.
State with_images(State image);

/// Returns the state on the first of 2 x 2 mirror images; nothing where the pressure is no such
/// images.
std::optional<State> state_of_image(const State& state);

}  // namespace tabor::contact
