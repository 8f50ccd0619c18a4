// ARKODE of SUNDIALS: ERKStep, explicit Runge-Kutta of order 4 (or order=2 to 8) with roots.
#include <arkode/arkode_erkstep.h>

#include "../sundials.hpp"

int main(int count, char** words) {
  Flights door(count, words);
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  auto first = door.first();
  auto y = N_VMake_Serial(sunindextype(door.size()), first.data(), context);
  auto* memory = ERKStepCreate(derivative, door.start, y, context);
  ERKStepSetOrder(memory, int(door.number("order", 4)));
  ERKStepSStolerances(memory, door.tolerance(), door.tolerance());
  ERKStepSetUserData(memory, &door);
  ERKStepSetMaxNumSteps(memory, 1000000);
  ERKStepRootInit(memory, int(door.contacts), gaps);
  std::vector<int> falling(door.contacts, -1);
  ERKStepSetRootDirection(memory, falling.data());
  realtype t = door.start;
  door.write(t, first.data());
  for (long k = 1; k <= door.rows;) {
    const int flag = ERKStepEvolve(memory, door.at(k), y, &t, ARK_NORMAL);
    if (flag < 0) return 1;
    if (flag != ARK_ROOT_RETURN) {
      door.write(door.at(k++), first.data());
      continue;
    }
    std::vector<int> found(door.contacts);
    ERKStepGetRootInfo(memory, found.data());
    for (std::size_t c = 0; c < found.size(); ++c)
      if (found[c] != 0) door.impact(c + 1, t, first.data());
    ERKStepReInit(memory, derivative, t, y);
  }
  return door.close();
}
