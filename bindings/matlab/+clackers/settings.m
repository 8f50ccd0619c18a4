% WORDS = clackers.settings(NAME, VALUE, ...): parameters of a case as the command takes them, with all digits.
function words = settings(varargin)
  words = {};
  for i = 1:2:numel(varargin)
    words = [words {'--set', sprintf('%s=%.17g', varargin{i}, varargin{i + 1})}];
  end
end
