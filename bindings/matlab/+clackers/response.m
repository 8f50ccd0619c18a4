% R = clackers.response(CASE, T, NAME, VALUE, ...): the exact motion at the times T [s], 0 <= T <= the end of the case.
% Fields t, u [m], v [m/s] and a [m/s^2] with a row a time and a column a mass; after the impact where a time is
% the double nearest to one.
function r = response(name, t, varargin)
  times = [tempname() '.txt'];
  file = fopen(times, 'w');
  fprintf(file, '%.17g\n', t);
  fclose(file);
  tidy = onCleanup(@() delete(times));
  words = clackers.settings(varargin{:});
  text = clackers.command('respond', name, words{:}, '--times', times, '--format', 'csv', '--quiet');
  lines = strsplit(strtrim(text), '\n');
  masses = (numel(strsplit(lines{1}, ',')) - 2) / 3;
  body = lines(2:end);
  body = body(cellfun(@isempty, strfind(body, ',-,')));   % states before an impact
  rows = cellfun(@(line) sscanf(regexprep(line, ',\+?,', ','), '%f,', [1, Inf]), body', 'UniformOutput', false);
  rows = cell2mat(rows);
  r.t = rows(:, 1);
  for i = 1:masses
    r.u(:, i) = rows(:, 3 * i - 1);
    r.v(:, i) = rows(:, 3 * i);
    r.a(:, i) = rows(:, 3 * i + 1);
  end
end
