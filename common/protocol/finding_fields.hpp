// The fields of the messages of what a calibration found; common/protocol/fields.hpp says what the lists are for.
#pragma once

#include "protocol/field_kinds.hpp"
#include "protocol/findings.hpp"

namespace demecal::inline protocol {

template <class Visitor, Fields<CauseFound> M>
void visit_fields(Visitor& visit, M& m) {
  visit("calibration", key(required(m.calibration)));
  visit("number", key(required(m.number)));
  visit("cause", bounded<63>(m.cause));
  visit("joint", m.joint);
  visit("label", bounded<255>(m.label));
  visit("without_m", m.without_m);
  visit("with_m", m.with_m);
  visit("share_of_error", m.share_of_error);
  visit("advice", bounded<1023>(m.advice));
}

template <class Visitor, Fields<FinalFigures> M>
void visit_fields(Visitor& visit, M& m) {
  visit("calibration", key(required(m.calibration)));
  visit("job", bounded<255>(m.job));
  visit("causes", m.causes);
  visit("effects", m.effects);
  visit("validation_before_m", m.validation_before_m);
  visit("validation_after_m", m.validation_after_m);
  visit("accept_before_m", m.accept_before_m);
  visit("accept_after_m", m.accept_after_m);
}

}  // namespace demecal::inline protocol
