! clackers_main.h for Fortran: the run that clackers_step is called with, and what it may call.
module clackers_main
  use, intrinsic :: iso_c_binding
  implicit none

  type, bind(c) :: clackers_run
    integer(c_int32_t) :: dof, contacts, loads, springs
    type(c_ptr) :: M, C, K               ! (dof, dof), symmetric
    type(c_ptr) :: direction             ! (dof, contacts): a contact is a column
    type(c_ptr) :: gap, restitution      ! (contacts)
    type(c_ptr) :: load, spring          ! (4, loads), (dof + 2, springs)
    type(c_ptr) :: u, v                  ! (dof), at the start
    real(c_double) :: start, end, step
    integer(c_int64_t) :: steps
    real(c_double) :: tolerance, t
    type(c_ptr) :: memory
  end type

  interface
    subroutine clackers_forces(run, t, u, f) bind(c)
      import
      type(clackers_run), intent(in) :: run
      real(c_double), value :: t
      real(c_double), intent(in) :: u(*)
      real(c_double), intent(out) :: f(*)
    end subroutine
    integer(c_int) function clackers_add_impact(run, t, impulse, before, after) bind(c)
      import
      type(clackers_run), intent(inout) :: run
      real(c_double), value :: t, impulse
      real(c_double), intent(in), optional :: before(*), after(*)
    end function
    integer(c_int) function clackers_add_state(run, t, u, v) bind(c)
      import
      type(clackers_run), intent(inout) :: run
      real(c_double), value :: t
      real(c_double), intent(in) :: u(*)
      real(c_double), intent(in), optional :: v(*)
    end function
    integer(c_int) function clackers_fail(run, reason) bind(c)
      import
      type(clackers_run), intent(inout) :: run
      character(kind=c_char), intent(in) :: reason(*)  ! ends with c_null_char
    end function
  end interface
end module
