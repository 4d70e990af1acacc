def judge_file(*a): raise NotImplementedError
