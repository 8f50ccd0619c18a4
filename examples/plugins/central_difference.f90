! A plug-in for `clackers verify --plugin`: the explicit central difference method, with impacts located
! within the step; order 2. README.md has the lines that compile and run it.
module central_difference
  use clackers_solver
  implicit none
  character(kind=c_char, len=*), parameter :: its_name = 'central-difference-f90'//c_null_char
  character(kind=c_char), target, save :: name(len(its_name)) = transfer(its_name, ' ', len(its_name))
  type(solver), target, save :: description
  integer, parameter :: most_impacts = 1000  ! in a step

contains

  function plugin() bind(c, name='clackers_plugin') result(pointer)
    type(c_ptr) :: pointer
    description = solver(solver_version, refines_step, c_loc(name), c_null_funptr, c_funloc(run), &
                         c_null_funptr)
    pointer = c_loc(description)
  end function

  integer(c_int32_t) function run(state, problem, task, host) bind(c, name='') result(status)
    type(c_ptr), value :: state  ! null: there is nothing to prepare
    type(solver_problem), intent(in) :: problem
    type(solver_run), intent(in) :: task
    type(solver_host), intent(inout) :: host
    procedure(state_function), pointer :: put_state
    procedure(collision_function), pointer :: put_collision
    procedure(fail_function), pointer :: fail
    real(c_double), pointer :: M(:,:), C(:,:), K(:,:), b(:,:), gap(:), restitution(:), start(:)
    real(c_double), dimension(problem%dof) :: u, v, u1, v1, before, y
    real(c_double) :: t, end, impulse, low, high
    integer(c_int64_t) :: i
    integer :: n, hit, impacts, j

    n = problem%dof
    call c_f_procpointer(host%state, put_state)
    call c_f_procpointer(host%collision, put_collision)
    call c_f_procpointer(host%fail, fail)
    call c_f_pointer(problem%M, M, [n, n])
    call c_f_pointer(problem%C, C, [n, n])
    call c_f_pointer(problem%K, K, [n, n])
    call c_f_pointer(problem%direction, b, [n, int(problem%contacts)])
    call c_f_pointer(problem%gap, gap, [int(problem%contacts)])
    call c_f_pointer(problem%restitution, restitution, [int(problem%contacts)])
    call c_f_pointer(problem%u, start, [n]); u = start
    call c_f_pointer(problem%v, start, [n]); v = start
    t = problem%start
    status = put_state(host, t, u, v)
    do i = 1, task%steps
      if (status /= 0) return
      end = problem%start + (problem%end - problem%start) * real(i, c_double) / real(task%steps, c_double)
      impacts = 0
      do
        call advance(end - t)
        if (violated() == 0) exit
        low = 0; high = end - t
        do j = 1, 60
          call advance((low + high) / 2)
          if (violated() == 0) then; low = (low + high) / 2; else; high = (low + high) / 2; end if
        end do
        call advance(high); hit = violated()
        call advance(low); t = t + low; u = u1; v = v1
        before = v
        y = solved(M, b(:,hit))
        impulse = -(1 + restitution(hit)) * dot_product(b(:,hit), v) / dot_product(b(:,hit), y)
        v = v + impulse * y
        status = put_collision(host, t, impulse, before, v)
        if (status /= 0) return
        impacts = impacts + 1
        if (impacts > most_impacts) then
          status = fail(host, 'impacts accumulate in a step'//c_null_char)
          return
        end if
      end do
      t = end; u = u1; v = v1
      status = put_state(host, t, u, v)
    end do

  contains

    subroutine advance(h)  ! u1 = u + h v', v' = v + h/2 a;  M (v1 - v') = -h/2 (C v1 + K u1)
      real(c_double), intent(in) :: h
      real(c_double) :: middle(n)
      middle = v - h / 2 * solved(M, matmul(C, v) + matmul(K, u))
      u1 = u + h * middle
      v1 = solved(M + h / 2 * C, matmul(M, middle) - h / 2 * matmul(K, u1))
    end subroutine

    integer function violated()  ! a contact with a negative gap that closes further, or 0
      do violated = problem%contacts, 1, -1
        if (dot_product(b(:,violated), u1) < gap(violated) .and. dot_product(b(:,violated), v1) < 0) return
      end do
    end function
  end function

  function solved(A, b) result(x)  ! A x = b by elimination; A is positive definite: no pivoting
    real(c_double), intent(in) :: A(:,:), b(:)
    real(c_double) :: x(size(b)), rows(size(b), size(b))
    integer :: i, j
    rows = A; x = b
    do i = 1, size(b)
      do j = i + 1, size(b)
        x(j) = x(j) - rows(j,i) / rows(i,i) * x(i)
        rows(j,i+1:) = rows(j,i+1:) - rows(j,i) / rows(i,i) * rows(i,i+1:)
      end do
    end do
    do i = size(b), 1, -1
      x(i) = (x(i) - dot_product(rows(i,i+1:), x(i+1:))) / rows(i,i)
    end do
  end function
end module
