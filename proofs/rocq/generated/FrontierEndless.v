(** What the kernel answers, written by `ROCQ_UPDATE=always cargo test -p tautline-proofs --test all rocq`. Do not edit. *)
From Coq Require Import ZArith NArith List.
Import ListNotations.

From Tautline Require Import Explorers.
Definition endless_without_Keep : (nat * nat * nat) * list nat * list nat * list (list (nat * nat) * bool * event nat)
  * list (list (nat * nat) * bool * event nat) := ((4,4,3),[0],[9;10;5;2],
  [([(0,8);(1,11);(2,6);(3,1)],false,Decides 0 8 8 []);([(1,11);(2,6);(3,1)],false,Looks 0 [] [] 0);
  ([(1,11);(2,6);(3,1)],false,Decides 1 11 11 []);([(2,6);(3,1)],false,Arrives 0 []);
  ([(0,9);(2,4);(3,1)],false,Decides 2 4 4 []);([(0,9);(3,1)],false,Looks 1 [] [] 0);
  ([(0,9);(3,1)],false,Arrives 1 []);([(0,9);(1,7);(3,1)],false,Looks 2 [] [] 0);
  ([(0,9);(1,7);(3,1)],false,Decides 0 9 6 []);([(1,7);(3,1)],false,Decides 1 7 7 []);
  ([(3,1)],false,Decides 3 1 1 [1]);([],false,Looks 1 [] [] 0);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 2 [1]);([(2,0)],false,Arrives 1 []);([(1,6);(2,0)],false,Arrives 0 []);
  ([(0,5);(1,11);(2,0)],false,Looks 3 [] [] 0);([(0,5);(1,11);(2,0)],false,Decides 1 11 0 []);
  ([(0,5);(2,0)],false,Looks 1 [] [] 0);([(0,5);(2,0)],false,Arrives 3 [0;1]);
  ([(0,5);(2,0);(3,0)],false,Decides 3 0 0 [0;1]);([(0,5);(2,0)],false,Looks 3 [0;1] [] 0);
  ([(0,5);(2,5);(3,2)],false,Arrives 1 []);([(0,5);(1,10);(2,5);(3,2)],false,Decides 1 10 0 []);
  ([(0,5);(2,5);(3,2)],false,Decides 2 5 6 [0;1]);([(0,5);(3,2)],false,Looks 1 [] [] 0);
  ([(0,5);(3,2)],false,Decides 3 2 3 [0;1]);([(0,5)],false,Looks 3 [] [] 0);([(0,5)],false,Looks 2 [] [] 0);
  ([(0,5)],false,Arrives 2 [0;1]);([(0,5);(2,6)],false,Arrives 3 [0;1]);([(0,5);(2,6);(3,3)],false,Arrives 1 []);
  ([(0,10);(1,9);(2,6);(3,3)],false,Decides 3 3 3 [0;1]);([(0,10);(1,9);(2,6)],false,Decides 2 6 6 [0;1]);
  ([(0,10);(1,9)],false,Looks 3 [] [] 0);([(0,10);(1,9)],false,Looks 2 [] [] 0);
  ([(0,10);(1,9)],false,Arrives 3 [0;1]);([(0,10);(1,9);(3,2)],false,Arrives 2 [0;1]);
  ([(0,10);(1,9)],false,Decides 0 10 3 []);([(1,9)],false,Looks 0 [] [] 0);([(1,9)],true,Decides 1 9 0 []);
  ([],true,Looks 1 [] [] 0)],
  [([],true,Ticks);([(1,9)],false,Decides 1 9 0 []);([],false,Looks 1 [] [] 1);([],true,Ticks);([],true,Ticks);
  ([],true,Ticks);([(0,10)],false,Decides 0 10 3 []);([],false,Looks 0 [] [] 0)]).
