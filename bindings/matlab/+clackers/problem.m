% P = clackers.problem(CASE, NAME, VALUE, ...): the problem that a solver integrates, M a + C v + K u = loads, with
% fields M [kg], C [N s/m], K [N/m], contacts (direction, gap [m], restitution), start (t [s], u [m], v [m/s])
% and t_end [s]. CASE and its parameters: clackers list cases, clackers show CASE.
function p = problem(name, varargin)
  words = clackers.settings(varargin{:});
  text = clackers.command('show', name, words{:}, '--format', 'json', '--quiet');
  shown = jsondecode(strrep(text, '"end":', '"t_end":'));  % end is no name of a field
  p = shown.problem;
end
