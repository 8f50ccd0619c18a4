// CVODE of SUNDIALS: method=bdf or method=adams with roots. reinit=no continues after an impact without
// CVodeReInit.
#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "../sundials.hpp"

int main(int count, char** words) {
  Flights door(count, words);
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  auto first = door.first();
  auto y = N_VMake_Serial(sunindextype(door.size()), first.data(), context);
  auto* memory = CVodeCreate(door.settings["method"] == "adams" ? CV_ADAMS : CV_BDF, context);
  CVodeInit(memory, derivative, door.start, y);
  CVodeSStolerances(memory, door.tolerance(), door.tolerance());
  CVodeSetUserData(memory, &door);
  auto matrix = SUNDenseMatrix(sunindextype(door.size()), sunindextype(door.size()), context);
  CVodeSetLinearSolver(memory, SUNLinSol_Dense(y, matrix, context), matrix);
  CVodeRootInit(memory, int(door.contacts), gaps);
  std::vector<int> falling(door.contacts, -1);  // else the restart on the surface is a root again
  CVodeSetRootDirection(memory, falling.data());
  CVodeSetMaxNumSteps(memory, 1000000);
  realtype t = door.start;
  door.write(t, first.data());
  for (long k = 1; k <= door.rows;) {
    const int flag = CVode(memory, door.at(k), y, &t, CV_NORMAL);
    if (flag < 0) return 1;
    if (flag != CV_ROOT_RETURN) {
      door.write(door.at(k++), first.data());
      continue;
    }
    std::vector<int> found(door.contacts);
    CVodeGetRootInfo(memory, found.data());
    for (std::size_t c = 0; c < found.size(); ++c)
      if (found[c] != 0) door.impact(c + 1, t, first.data());
    if (door.settings["reinit"] != "no") CVodeReInit(memory, t, y);
  }
  return door.close();
}
