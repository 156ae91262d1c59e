// SPDX-License-Identifier: MIT
// Contact models that the user selects: the impact law and the parameters of the penalty method.
#pragma once

namespace hyoryu {

/// The impact law. Resting contacts are solved in the same way under every law.
///
/// - coupled: rounds. All contacts that approach are solved together, each with the restitution of
///   its own approach and friction in the circular Coulomb cone, normal and tangential impulse
///   coupled; then looked at again until none approaches. Never gains energy.
/// - paper: equations (1)-(6) of the Iwate paper as they stand: J = -(1 + e) n.v / (n.K n), and the
///   friction min(mu J, |b|), b = t.v / (t.K t), against the velocity before the impact, neither
///   knowing of the other. One face after another until none approaches; a face acts at the mean of
///   its points that approach. Kept to compare with: it can gain energy.
/// - simultaneous: Moreau's law. All touching contacts of an island are solved at once, those that
///   do not approach included, with the coupled cone; a struck body does not bounce off where it
///   already rested. Never gains energy.
enum class ImpactLaw { coupled, paper, simultaneous };

/// Parameters of the penalty method: the spring and dashpot of a pair of particles, and the
/// sub-step. The defaults give the cube of the paper contacts of 4 ms and a restitution of 0.75 on
/// a symmetric lattice (contact notes, section 4).
struct PenaltyParameters {
    double stiffness = 1000; // k of a pair of particles [N/m]; N/m2 in two dimensions
    double damping = 0.2171; // c of a pair of particles [N s/m]; N s/m2 in two dimensions
    double step = 1e-5;      // longest sub-step of the explicit integration [s]
};

} // namespace hyoryu
