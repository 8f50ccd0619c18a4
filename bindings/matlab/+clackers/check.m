% [FOUND, TEXT] = clackers.check(RUNS, CASE, NAME, VALUE, ...) judges a ladder of runs of one solver against the exact
% motion. RUNS: a cell array of structures with t [s], u [m] and v [m/s], a row a time and a column a mass, each of
% another step; at least four for an order. FOUND has verdict, behaviour, order, order_spread and causes (codes; see
% clackers explain CODE), TEXT is the table that people read. '--expect' and other options of clackers check stand
% among the names: clackers.check(runs, 'stop', 'eta', 0.7, '--expect', 'proper:2').
function [found, text] = check(runs, name, varargin)
  is_option = cellfun(@(word) ischar(word) && strncmp(word, '--', 2), varargin);
  options = {};
  for i = find(is_option)
    options = [options varargin(i:i + 1)];
    varargin(i:i + 1) = {[]};
  end
  varargin = varargin(~cellfun(@isempty, varargin));
  folder = tempname();
  mkdir(folder);
  files = {};
  for k = 1:numel(runs)
    run = runs{k};
    files{k} = fullfile(folder, sprintf('run%02d.csv', k));
    masses = size(run.u, 2);
    heads = arrayfun(@(i) sprintf(',u%d,v%d', i, i), 1:masses, 'UniformOutput', false);
    columns = reshape([run.u; run.v], numel(run.t), 2 * masses);
    file = fopen(files{k}, 'w');
    fprintf(file, 't%s\n', [heads{:}]);
    fprintf(file, [repmat('%.17g,', 1, 2 * masses) '%.17g\n'], [run.t(:) columns]');
    fclose(file);
  end
  words = clackers.settings(varargin{:});
  common = [{'check'} files {'--case', name} words options];
  record = jsondecode(clackers.command(common{:}, '--format', 'json', '--quiet'));
  if nargout > 1
    text = clackers.command(common{:}, '--quiet');
  end
  cellfun(@delete, files);
  rmdir(folder);
  subject = record.cases(1).subjects(1);
  fit = subject.assessment.displacement;
  causes = {};
  if ~isempty(subject.diagnoses)
    causes = {subject.diagnoses.code};
  end
  found = struct('verdict', subject.assessment.verdict, 'behaviour', fit.behaviour, 'order', NaN, 'order_spread', NaN);
  if fit.has_line
    found.order = fit.order;
    found.order_spread = fit.spread;
  end
  found.causes = causes;
end
