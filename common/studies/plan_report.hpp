// A measurement's plan as figures and words: plan.json, and what pages and terminals share.
#pragma once

#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "parameters/declared_model.hpp"
#include "planning/plan.hpp"

namespace demecal::inline studies {

/// The document of a plan; `files` are those written beside it.
std::string to_json(const Plan& plan, const PlanRequest& request, const std::vector<std::string>& files);

/// A number's name without its unit, its unit, and how many of it a unit inside is: deg (or mrad for errors) and mm.
struct NumberUnit {
  std::string unit;
  double per_inside = 1.0;
};
/// In which errors of the number are stated: mm, mrad, or SI of effects.
NumberUnit error_unit(const ParameterId& id);

/// "backlash of joint 2: 0.12 mrad": the effect and the size that would be found.
std::string detectable_text(const DetectableSize& detectable, const Robot& robot);

/// Where the sockets are to stand: "S1 at 450, -120, 30 mm", and what is known between them.
std::vector<std::string> socket_sentences(const Plan& plan);
/// "1 place: 0.21 mm, 2: 0.12 mm": what as many poses at fewer or more places would leave; empty without sockets.
std::string places_sentence(const Plan& plan);

/// The sentences on what the poses will not tell.
std::vector<std::string> unidentified_sentences(const Plan& plan);

}  // namespace demecal::inline studies
