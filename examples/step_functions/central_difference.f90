! A step function for clackers_main.h: the explicit central difference method, with impacts located
! within the step; order 2. README.md has the lines that compile and run it.
integer(c_int) function clackers_step(run, t1, u, v) bind(c) result(status)
  use clackers_main
  implicit none
  type(clackers_run), intent(inout) :: run
  real(c_double), value :: t1
  real(c_double), intent(inout) :: u(run%dof), v(run%dof)
  integer, parameter :: most_impacts = 1000  ! in a step
  real(c_double), pointer :: M(:,:), C(:,:), K(:,:), b(:,:), gap(:), restitution(:)
  real(c_double), dimension(run%dof) :: u2, v2, before, y
  real(c_double) :: t, impulse, low, high
  integer :: n, hit, impacts, j

  n = run%dof
  call c_f_pointer(run%M, M, [n, n])
  call c_f_pointer(run%C, C, [n, n])
  call c_f_pointer(run%K, K, [n, n])
  call c_f_pointer(run%direction, b, [n, int(run%contacts)])
  call c_f_pointer(run%gap, gap, [int(run%contacts)])
  call c_f_pointer(run%restitution, restitution, [int(run%contacts)])
  t = run%t
  impacts = 0
  do
    call advance(t1 - t)
    if (violated() == 0) exit
    low = 0; high = t1 - t
    do j = 1, 60
      call advance((low + high) / 2)
      if (violated() == 0) then; low = (low + high) / 2; else; high = (low + high) / 2; end if
    end do
    call advance(high); hit = violated()
    call advance(low); t = t + low; u = u2; v = v2
    before = v
    y = solved(M, b(:,hit))
    impulse = -(1 + restitution(hit)) * dot_product(b(:,hit), v) / dot_product(b(:,hit), y)
    v = v + impulse * y
    status = clackers_add_impact(run, t, impulse, before, v)
    if (status /= 0) return
    impacts = impacts + 1
    if (impacts > most_impacts) then
      status = clackers_fail(run, 'impacts accumulate in a step'//c_null_char)
      return
    end if
  end do
  u = u2; v = v2
  status = 0

contains

  subroutine advance(h)  ! u2 = u + h w, w = v + h/2 a;  M (v2 - w) = h/2 (f2 - C v2 - K u2)
    real(c_double), intent(in) :: h
    real(c_double) :: w(n), f(n)
    call clackers_forces(run, t, u, f)
    w = v + h / 2 * solved(M, f - matmul(C, v) - matmul(K, u))
    u2 = u + h * w
    call clackers_forces(run, t + h, u2, f)
    v2 = solved(M + h / 2 * C, matmul(M, w) + h / 2 * (f - matmul(K, u2)))
  end subroutine

  integer function violated()  ! a contact with a negative gap that closes further, or 0
    do violated = run%contacts, 1, -1
      if (dot_product(b(:,violated), u2) < gap(violated) .and. dot_product(b(:,violated), v2) < 0) return
    end do
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
end function
