! clackers_solver.h for Fortran: the types of a plug-in, and how the functions that it is handed are called.
module clackers_solver
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int32_t), parameter :: solver_version = 1, refines_step = 0, refines_tolerance = 1

  type, bind(c) :: solver_problem
    integer(c_int32_t) :: dof, contacts
    type(c_ptr) :: M, C, K       ! (dof, dof), symmetric
    type(c_ptr) :: direction     ! (dof, contacts): a contact is a column
    type(c_ptr) :: gap, restitution
    real(c_double) :: start, end
    type(c_ptr) :: u, v
  end type

  type, bind(c) :: solver_run
    real(c_double) :: step
    integer(c_int64_t) :: steps
    real(c_double) :: tolerance
  end type

  type, bind(c) :: solver_host
    integer(c_int32_t) :: version
    type(c_funptr) :: state, collision, fail  ! of the interfaces below, by c_f_procpointer
  end type

  type, bind(c) :: solver
    integer(c_int32_t) :: version, refines
    type(c_ptr) :: name
    type(c_funptr) :: prepare, run, free
  end type

  abstract interface
    integer(c_int32_t) function state_function(host, t, u, v, a) bind(c)
      import
      type(solver_host) :: host
      real(c_double), value :: t
      real(c_double), intent(in) :: u(*)
      real(c_double), intent(in), optional :: v(*), a(*)
    end function
    integer(c_int32_t) function collision_function(host, t, impulse, before, after) bind(c)
      import
      type(solver_host) :: host
      real(c_double), value :: t, impulse
      real(c_double), intent(in), optional :: before(*), after(*)
    end function
    integer(c_int32_t) function fail_function(host, reason) bind(c)
      import
      type(solver_host) :: host
      character(kind=c_char), intent(in) :: reason(*)  ! ends with c_null_char
    end function
  end interface
end module
