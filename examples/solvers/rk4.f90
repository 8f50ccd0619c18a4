! Runge-Kutta, diagonal M, impacts located by bisection: order 4. rk4 PROBLEM.txt STEPS HISTORY
program rk4
  implicit none
  real(8), allocatable :: M(:), C(:,:), K(:,:), b(:,:), gap(:), eta(:), y(:), y1(:), row(:)
  real(8) :: t, end, left, low, high
  character(4096) :: name
  integer :: n, contacts, i, j, hit, steps
  call get_command_argument(1, name)
  open(10, file=name, status='old', action='read')
  n = nint(sum(values(1))); contacts = nint(sum(values(1))); t = sum(values(1)); end = sum(values(1))
  allocate(M(n), C(n,n), K(n,n), b(contacts,n), gap(contacts), eta(contacts))
  y = values(n); y = [y, values(n)]; y1 = y
  do i = 1, n; row = values(n); M(i) = row(i); end do
  do i = 1, n; C(i,:) = values(n) / M(i); end do
  do i = 1, n; K(i,:) = values(n) / M(i); end do
  do i = 1, contacts; b(i,:) = values(n); gap(i) = sum(values(1)); eta(i) = sum(values(1)); end do
  call get_command_argument(2, name); read(name, *) steps
  call get_command_argument(3, name); open(11, file=name, action='write')
  write(11, '(a,*(a,i0))') 't', (',u', i, i = 1, n), (',v', i, i = 1, n)
  do i = 0, steps
    write(11, '(*(es25.17e3,:,","))') t + (end - t) * i / steps, y
    left = (end - t) / steps
    do
      y1 = stepped(y, left); if (closing(y1) == 0) exit
      low = 0; high = left
      do j = 1, 60
        hit = closing(stepped(y, (low + high) / 2))
        if (hit == 0) low = (low + high) / 2
        if (hit > 0) high = (low + high) / 2
      end do
      hit = closing(stepped(y, high)); y = stepped(y, low); left = left - low
      y(n+1:) = y(n+1:) - (1 + eta(hit)) * dot_product(b(hit,:), y(n+1:)) &
                / sum(b(hit,:)**2 / M) * b(hit,:) / M
    end do
    y = y1
  end do
contains
  function values(count) result(x)  ! of the next line, name=values
    integer, intent(in) :: count
    real(8) :: x(count)
    character(4096) :: line
    read(10, '(a)') line; read(line(index(line, '=') + 1:), *) x
  end function
  function rate(y) result(dy)  ! of y = (u, v)
    real(8) :: y(:), dy(size(y))
    dy = [y(n+1:), -matmul(C, y(n+1:)) - matmul(K, y(:n))]
  end function
  function stepped(y, h) result(y1)
    real(8) :: y(:), h, y1(size(y)), k1(size(y)), k2(size(y)), k3(size(y))
    k1 = rate(y); k2 = rate(y + h / 2 * k1); k3 = rate(y + h / 2 * k2)
    y1 = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3))
  end function
  integer function closing(y)  ! a contact with a negative gap that closes further, or 0
    real(8) :: y(:)
    do closing = contacts, 1, -1
      if (dot_product(b(closing,:), y(:n)) < gap(closing) .and. dot_product(b(closing,:), y(n+1:)) < 0) return
    end do
  end function
end program
