// A program that was written for version 1.0: it includes headers by names that they no longer
// have.

#include <touchdown/estimator/assembly/record.hpp>
#include <touchdown/estimator/assembly/signal_assembler.hpp>
#include <touchdown/estimator/c_interface/handle.hpp>
#include <touchdown/estimator/c_interface/touchdown.h>
#include <touchdown/estimator/models/compiled.hpp>

int main() {
  touchdown::SignalAssembler assembler{touchdown::AssemblyConfig()};
  const touchdown::Signals signals = assembler.assemble(touchdown::RobotRecord());
  const touchdown_record record = touchdown_empty_record();
  return signals.time == record.time ? 1 : 0;  // both are unknown, which equals nothing
}
