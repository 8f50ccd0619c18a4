% TEXT = clackers.command(WORD, ...) runs the command with these words and returns its standard output. What it
% refuses is an error with its message; a verdict against a claim (exit status 1) or undecided (3) is none.
function text = command(varargin)
  program = getenv('CLACKERS');
  if isempty(program)
    program = 'clackers';
  end
  words = cellfun(@(word) ['''' strrep(word, '''', '''\''''') ''''], [{program} varargin], 'UniformOutput', false);
  notes = [tempname() '.txt'];
  [status, text] = system([strjoin(words, ' ') ' 2> ''' notes '''']);
  message = '';
  if exist(notes, 'file')
    message = strtrim(fileread(notes));
    delete(notes);
  end
  if ~any(status == [0 1 3])
    error('clackers:refused', '%s', message);
  end
end
