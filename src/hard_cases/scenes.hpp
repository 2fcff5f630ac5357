#pragma once

#include <string>

#include "scene/scene.hpp"

namespace hbvm::core {

/// The scenes of the hard cases, each made of a parameter (exact text, as in scene files).

/// Earth, Moon and a satellite of 1000 kg in kg, m and s.
Scene earth_moon_satellite();
/// Two argon atoms that vibrate, in kg, m and s.
Scene argon_pair();
/// A free body of mass 1 beside Kepler's problem, uncoupled, for a body of this mass; a spring of this stiffness
/// between them, if any.
Scene beside_kepler(const std::string& mass, const std::string& stiffness = "");
/// Kepler's problem with this eccentricity, started at the pericentre or the apocentre.
Scene kepler(const std::string& eccentricity, bool at_pericentre = true);
/// Double pendulum with these masses and this length of the second rod.
Scene double_pendulum(const std::string& mass_a, const std::string& mass_b, const std::string& length = "13/10");
/// A charged double pendulum with its lengths, masses and times multiplied by these powers of two.
Scene scaled_pendulum(int length, int mass, int time);
/// A pendulum at rest, this angle away from upright.
Scene near_upright(const std::string& angle);
/// A charged pendulum that passes below its lowest point a charge that attracts it, this far from the rod's end.
Scene charge_below(const std::string& distance);
/// Two bodies that fall towards each other with this velocity across.
Scene near_collision(const std::string& velocity);
/// A rigid triangle whose corner lies this far from the line through the others; it turns.
Scene flat_triangle(const std::string& height);
/// A body held in space by two rods that are this far from collinear.
Scene stretched_rods(const std::string& height);
/// A four-bar linkage, one crank longer by this, which runs through its folded position.
Scene folding_linkage(const std::string& difference);
/// Three bodies in a line, held by three rods; the middle one is this far off the line.
Scene rods_in_line(const std::string& height);
/// A pendulum held by the same rod twice; lengths 1, and 1 plus this.
Scene doubled_rod(const std::string& difference);
/// A body on a spring of this stiffness about a point, with gravity.
Scene spring_pendulum(const std::string& stiffness);
/// The same with a spring of rest length 0: a linear oscillator.
Scene oscillator(const std::string& stiffness);
/// A pendulum whose bob another body hangs on by a spring of this stiffness.
Scene pendulum_with_spring(const std::string& stiffness);
/// Two bodies on a spring of stiffness 1, with a gravity of this strength.
Scene weak_gravity(const std::string& strength);
/// So many rods released from horizontal, masses falling by a factor of 9/10 from one to the next.
Scene whip(int rods);
/// So many equal charges on the unit sphere.
Scene beads_on_sphere(int beads);

}  // namespace hbvm::core
