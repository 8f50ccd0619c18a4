// IDA of SUNDIALS: the equation of motion in implicit form, backward differences with roots.
#include <ida/ida.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "../sundials.hpp"

int residual(realtype t, N_Vector y, N_Vector rate, N_Vector out, void* door) {
  derivative(t, y, out, door);
  N_VLinearSum(1.0, rate, -1.0, out, out);
  return 0;
}
int gaps_of(realtype t, N_Vector y, N_Vector, realtype* out, void* door) {
  return gaps(t, y, out, door);
}

int main(int count, char** words) {
  Flights door(count, words);
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  auto first = door.first();
  Row second(door.size());
  door.derivative(first.data(), second.data());
  const auto n = sunindextype(door.size());
  auto y = N_VMake_Serial(n, first.data(), context),
       rate = N_VMake_Serial(n, second.data(), context);
  auto* memory = IDACreate(context);
  IDAInit(memory, residual, door.start, y, rate);
  IDASStolerances(memory, door.tolerance(), door.tolerance());
  IDASetUserData(memory, &door);
  auto matrix = SUNDenseMatrix(n, n, context);
  IDASetLinearSolver(memory, SUNLinSol_Dense(y, matrix, context), matrix);
  IDARootInit(memory, int(door.contacts), gaps_of);
  std::vector<int> falling(door.contacts, -1);
  IDASetRootDirection(memory, falling.data());
  IDASetMaxNumSteps(memory, 1000000);
  realtype t = door.start;
  door.write(t, first.data());
  for (long k = 1; k <= door.rows;) {
    const int flag = IDASolve(memory, door.at(k), &t, y, rate, IDA_NORMAL);
    if (flag < 0) return 1;
    if (flag != IDA_ROOT_RETURN) {
      door.write(door.at(k++), first.data());
      continue;
    }
    std::vector<int> found(door.contacts);
    IDAGetRootInfo(memory, found.data());
    for (std::size_t c = 0; c < found.size(); ++c)
      if (found[c] != 0) door.impact(c + 1, t, first.data());
    door.derivative(first.data(), second.data());
    IDAReInit(memory, t, y, rate);
  }
  return door.close();
}
