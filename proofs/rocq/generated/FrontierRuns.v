(** What the kernel answers, written by `ROCQ_UPDATE=always cargo test -p tautline-proofs --test all rocq`. Do not edit. *)
From Coq Require Import ZArith NArith List.
Import ListNotations.

From Tautline Require Import Explorers.
Definition runs_PLAIN : list ((nat * nat * nat) * list nat * list nat * list (list (nat * nat) * bool * event nat)
  * list (list nat * list nat * nat)) := [
 ((1,3,3),[6;0],[3],
  [([(0,0);(0,4);(0,6)],false,Decides 0 0 0 []);([],false,Looks 0 [] [] 0);([(0,4);(0,6)],false,Decides 0 4 4 []);
  ([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);([(0,1);(0,5);(0,7)],false,Decides 0 5 5 []);
  ([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);([(0,2);(0,8)],false,Decides 0 8 8 []);
  ([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);([(0,7)],false,Decides 0 7 7 []);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 0 []);([(0,6)],false,Decides 0 6 6 []);([],false,Looks 0 [] [] 0);
  ([(0,4)],false,Decides 0 4 1 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,1)],false,Decides 0 1 1 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,2)],false,Decides 0 2 2 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 [])],
  [([1;2;3;4;5;7;8],[0;6],2)]);
 ((2,3,2),[1;3],[5;2],
  [([(0,4);(1,1)],false,Decides 0 4 4 []);([(1,1)],false,Looks 0 [] [] 0);([(1,1)],false,Arrives 0 [1]);
  ([(0,1);(0,3);(1,1)],false,Decides 1 1 1 []);([(0,1);(0,3)],false,Looks 1 [0] [] 0);
  ([(0,1);(0,3);(1,5)],false,Decides 0 1 1 []);([(1,5)],false,Looks 0 [1] [] 0);
  ([(0,3);(1,5)],false,Decides 0 3 3 []);([(1,5)],false,Looks 0 [] [] 0)],
  [([2;4;5],[1;3],4);([2;4;5],[1;3],2)]);
 ((3,3,2),[4;2],[3;0;1],
  [([(0,4);(1,1);(1,3);(2,2);(2,4)],false,Decides 0 4 4 []);([(1,1);(1,3);(2,2);(2,4)],false,Decides 1 3 4 []);
  ([(2,2);(2,4)],false,Decides 2 4 4 []);([],false,Looks 1 [] [] 0);([],false,Looks 0 [1;2] [] 0);
  ([],true,Looks 2 [] [] 0);([(2,2)],true,Ticks);([(1,1);(2,2)],false,Decides 2 2 2 []);
  ([(1,1)],false,Looks 2 [] [] 0)],
  [([0;1;3],[2;4],3);([0;1;3],[2;4],0);([0;1;3],[2;4],1)]);
 ((4,3,2),[4;5],[2;3;1;0],
  [([(0,5);(1,4);(2,4);(3,1);(3,3)],false,Decides 2 4 4 []);([(0,5);(1,4);(3,1);(3,3)],false,Looks 2 [0;3] [] 0);
  ([(0,5);(1,0);(2,2);(3,1);(3,3)],false,Decides 1 0 5 []);([(0,5);(2,2);(3,1);(3,3)],false,Decides 3 1 4 []);
  ([(0,5);(2,2)],false,Looks 1 [0] [] 3);([(0,5);(2,2)],false,Decides 0 5 5 []);([(2,2)],false,Decides 2 2 5 []);
  ([],false,Looks 0 [] [] 0);([(0,1)],false,Looks 3 [] [] 0);([],false,Looks 2 [] [] 0)],
  [([0;1;2;3],[4;5],2);([0;1;2;3],[4;5],3);([0;1;2;3],[4;5],1);([0;1;2;3],[4;5],0)]);
 ((2,3,3),[5;3],[6;2],
  [([(0,3);(0,7);(1,1);(1,5)],false,Decides 1 1 1 []);([(0,3);(0,7)],false,Decides 0 3 3 []);
  ([],false,Looks 0 [1] [] 0);([(0,7)],false,Looks 1 [] [] 0);([(0,7)],false,Arrives 1 [0]);
  ([(0,7);(1,0);(1,4)],false,Decides 1 0 0 []);([(0,7)],false,Decides 0 7 7 []);([],false,Looks 1 [] [] 0);
  ([],false,Arrives 1 [0]);([(1,3)],false,Decides 1 3 3 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,4);(0,8)],false,Decides 0 4 4 []);([],false,Looks 1 [] [] 0);([(1,1)],false,Decides 1 1 4 []);
  ([],false,Looks 1 [] [] 0);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);([(0,5)],false,Decides 0 5 5 []);
  ([],false,Looks 0 [] [] 0);([(0,7)],false,Decides 0 7 8 []);([],false,Arrives 1 []);
  ([(1,4)],false,Looks 0 [] [] 0);([(1,4)],false,Decides 1 4 8 []);([],false,Arrives 0 []);
  ([(0,8)],false,Looks 1 [] [] 0);([(0,8)],false,Arrives 1 []);([(0,8);(1,7)],false,Decides 1 7 8 []);
  ([(0,8)],false,Looks 1 [] [] 0);([(0,8)],true,Decides 0 8 8 []);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 0 [])],
  [([0;1;2;4;6;7;8],[3;5],8);([0;1;2;4;6;7;8],[3;5],4)]);
 ((3,3,3),[8;4],[2;3;0],
  [([(0,1);(0,5);(1,4);(1,6);(2,1)],false,Decides 0 5 5 []);([(1,4);(1,6);(2,1)],false,Decides 2 1 1 []);
  ([(1,4);(1,6)],false,Decides 1 4 4 []);([],false,Looks 1 [0] [] 0);([(1,6)],false,Looks 0 [] [] 0);
  ([(1,6)],false,Arrives 0 [1;2]);([(0,4);(0,8);(1,6)],false,Decides 0 4 4 []);([(1,6)],false,Decides 1 6 6 []);
  ([],false,Looks 0 [] [] 0);([(0,8)],false,Looks 1 [] [] 0);([(0,8)],false,Arrives 1 []);
  ([(0,8);(1,7)],false,Decides 1 7 7 []);([(0,8)],false,Looks 1 [] [] 0);([(0,8)],false,Arrives 1 []);
  ([(0,8);(1,8)],false,Decides 0 8 8 []);([(1,8)],false,Looks 0 [] [] 0);([(0,2);(1,6)],false,Looks 2 [] [] 0);
  ([(0,2);(1,6)],false,Decides 1 6 1 []);([(0,2)],false,Looks 1 [] [] 0);([(0,2)],false,Decides 0 2 1 []);
  ([],false,Arrives 1 []);([(1,3)],false,Looks 0 [] [] 0);([(1,3)],false,Arrives 2 []);([],false,Arrives 0 [])],
  [([0;1;2;3;5;6;7],[4;8],2);([0;1;2;3;5;6;7],[4;8],6);([0;1;2;3;5;6;7],[4;8],1)]);
 ((3,5,1),[1;3],[4;0;2],
  [([(0,3);(1,1);(2,1);(2,3)],false,Decides 0 3 3 []);([(1,1);(2,1);(2,3)],false,Decides 2 1 1 []);
  ([(1,1)],false,Looks 0 [1] [] 0);([(1,1)],false,Looks 2 [] [] 0)],
  [([0;2;4],[1;3],4);([0;2;4],[1;3],0);([0;2;4],[1;3],2)]);
 ((3,5,1),[3;2],[0;1;4],
  [([(0,1);(1,2);(2,3)],false,Decides 1 2 2 []);([(0,1);(2,3)],false,Looks 1 [2] [] 0);
  ([(2,3)],false,Decides 2 3 3 []);([],false,Looks 2 [0;1] [] 0)],
  [([0;1;4],[2],0);([0;1;4],[2],1);([0;1;4],[3],4)]);
 ((3,5,1),[0;3],[2;4;1],
  [([(0,3);(1,3);(2,0)],false,Decides 1 3 3 []);([(0,3);(2,0)],false,Decides 0 3 3 []);
  ([(2,0)],false,Looks 0 [1] [1] 1);([(2,0)],false,Looks 1 [0] [] 1);([(2,0)],true,Decides 2 0 0 []);
  ([],true,Looks 2 [] [] 0)],
  [([1;2;4],[0;3],2);([1;2;4],[0;3],4);([1;2;4],[0;3],1)]);
 ((3,5,1),[3;4],[1;0;2],
  [([(0,2);(1,1);(2,3)],false,Decides 1 1 3 []);([(0,2);(2,3)],false,Decides 2 3 3 []);
  ([(0,2)],false,Looks 1 [2] [] 0);([(0,2)],true,Looks 2 [0;1] [] 0);([(0,2)],true,Ticks);
  ([(0,2);(1,1)],false,Decides 0 2 3 []);([(1,1)],false,Decides 1 1 3 []);([],false,Looks 0 [] [] 1);
  ([],false,Looks 1 [] [] 0)],
  [([0;1;2],[3],1);([0;1;2],[3],0);([0;1;2],[3],2)]);
 ((3,5,1),[3;2],[1;0;4],
  [([(0,2);(1,1);(2,3)],false,Decides 0 2 2 []);([(1,1);(2,3)],false,Looks 0 [1] [] 0);
  ([(1,1);(2,3)],false,Decides 2 3 3 []);([(1,1)],false,Looks 2 [0;1] [] 0);([(1,1)],false,Decides 1 1 2 []);
  ([],false,Looks 1 [] [] 0)],
  [([0;1;4],[2],1);([0;1;4],[2],0);([0;1;4],[2;3],4)]);
 ((3,5,1),[0;3],[2;1;4],
  [([(0,3);(1,0);(2,3)],false,Decides 1 0 0 []);([(0,3);(2,3)],false,Looks 1 [0] [] 0);
  ([(0,3);(1,2);(2,3)],false,Decides 1 2 3 []);([(0,3);(2,3)],false,Looks 1 [2] [0] 1);
  ([(0,3);(2,3)],true,Decides 2 3 3 []);([(0,3)],true,Decides 0 3 3 []);([],true,Ticks);
  ([],false,Looks 2 [] [] 2);([],false,Looks 0 [] [] 0)],
  [([1;2;4],[0;3],2);([1;2;4],[0;3],1);([1;2;4],[0;3],4)]);
 ((3,4,2),[5;6],[1;0;2],
  [([(0,5);(1,4);(2,3);(2,6)],false,Decides 2 6 6 []);([(0,5);(1,4)],false,Decides 0 5 5 []);
  ([(1,4)],false,Looks 2 [0;1] [] 0);([(1,4);(2,3)],false,Looks 0 [2] [] 0);
  ([(0,0);(0,2);(1,4);(2,3)],false,Decides 0 2 3 []);([(1,4);(2,3)],false,Decides 2 3 3 []);
  ([(1,4)],false,Looks 2 [] [] 0);([(1,4)],false,Arrives 2 []);([(1,4);(2,7)],false,Looks 0 [] [] 0);
  ([(1,4);(2,7)],false,Decides 2 7 7 []);([(1,4)],false,Looks 2 [] [] 0);([(1,4)],false,Decides 1 4 4 []);
  ([],false,Looks 1 [] [] 0);([],false,Arrives 0 []);([(0,3)],false,Arrives 1 []);
  ([(0,3);(1,0)],false,Decides 1 0 7 []);([(0,3)],false,Decides 0 3 7 []);([],false,Looks 0 [] [] 1);
  ([],false,Arrives 2 []);([],false,Looks 1 [] [] 0);([],false,Arrives 1 [])],
  [([0;1;2;3;4;7],[5;6],2);([0;1;2;3;4;7],[5;6],0);([0;1;2;3;4;7],[5;6],7)]);
 ((3,4,2),[4;7],[1;0;6],
  [([(0,2);(0,5);(1,4);(2,2);(2,5);(2,7)],false,Decides 2 5 5 []);([(0,2);(0,5);(1,4)],false,Decides 0 2 2 []);
  ([(1,4)],false,Looks 2 [] [] 0);([(1,4)],false,Arrives 2 [0;1]);([(1,4);(2,4)],false,Decides 1 4 4 []);
  ([(2,4)],false,Looks 1 [] [] 0);([(1,1);(2,1);(2,6)],false,Decides 2 1 2 []);([(1,1)],false,Looks 2 [1] [] 2);
  ([(1,1)],true,Looks 0 [] [] 2);([(1,1)],true,Decides 1 1 2 []);([],true,Looks 1 [] [] 2);
  ([],true,Arrives 0 []);([(0,3)],true,Ticks);([(0,3)],true,Decides 0 3 3 []);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 0 []);([(0,7)],true,Ticks);([(0,7);(1,1)],false,Decides 0 7 7 []);
  ([(1,1)],false,Decides 1 1 7 []);([],false,Looks 0 [] [] 0);([],false,Looks 1 [] [] 0);([],false,Arrives 1 [])],
  [([0;1;2;3;5;6],[4;7],3);([0;1;2;3;5;6],[4;7],1);([0;1;2;3;5;6],[4;7],5)]);
 ((3,4,2),[0;3],[1;7;4],
  [([(0,0);(0,2);(0,5);(1,3);(1,6);(2,0);(2,5)],false,Decides 0 2 2 []);
  ([(1,3);(1,6);(2,0);(2,5)],false,Decides 1 6 6 []);([(2,0);(2,5)],false,Decides 2 5 5 []);
  ([],false,Looks 0 [] [] 0);([],false,Arrives 0 [2]);([(0,3);(0,6)],false,Decides 0 6 6 []);
  ([],false,Looks 1 [0] [0] 1);([],true,Looks 0 [] [] 1);([],true,Arrives 0 []);([(0,5)],true,Looks 2 [] [] 1);
  ([(0,5)],true,Arrives 2 []);([(0,2);(0,7);(2,1);(2,4)],true,Decides 2 4 0 []);
  ([(0,2);(0,7)],true,Looks 2 [] [] 1);([(0,2);(0,7)],true,Ticks);([(0,2);(0,7)],false,Decides 0 2 3 []);
  ([],false,Arrives 2 []);([(2,0)],true,Ticks);([(2,0)],false,Decides 2 0 0 []);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 0 []);([(0,3)],true,Looks 2 [] [] 0);([(0,3);(2,5)],true,Ticks);
  ([(0,3);(1,3);(2,5)],false,Decides 2 5 3 []);([(0,3);(1,3)],false,Looks 2 [] [] 1);
  ([(0,3);(1,3)],false,Decides 0 3 3 []);([(1,3)],false,Decides 1 3 3 []);([],false,Looks 0 [] [] 1);
  ([],false,Arrives 2 []);([(2,1);(2,6)],false,Decides 2 6 3 []);([],false,Looks 2 [] [] 1);
  ([],false,Looks 1 [] [] 0);([],false,Arrives 2 [])],
  [([1;2;4;5;6;7],[0;3],2);([1;2;4;5;6;7],[0;3],7);([1;2;4;5;6;7],[0;3],6)]);
 ((3,4,2),[1;7],[5;4;3],
  [([(0,1);(0,6);(1,0);(2,2);(2,7)],false,Decides 0 6 6 []);([(1,0);(2,2);(2,7)],false,Looks 0 [] [] 0);
  ([(1,0);(2,2);(2,7)],false,Arrives 0 [2]);([(0,2);(0,7);(1,0);(2,2);(2,7)],false,Decides 0 7 7 []);
  ([(1,0);(2,2);(2,7)],false,Decides 2 7 7 []);([(1,0)],false,Looks 2 [] [] 0);
  ([(1,0)],false,Looks 0 [1;2] [] 0);([(0,2);(1,0)],true,Decides 1 0 0 []);([(0,2)],true,Ticks);
  ([(0,2)],false,Decides 0 2 2 []);([],false,Looks 1 [] [] 1);([],false,Looks 0 [] [] 1);([],false,Arrives 0 []);
  ([(0,1)],false,Arrives 1 []);([(0,1);(1,1)],true,Decides 0 1 1 []);([(1,1)],true,Looks 0 [] [] 0)],
  [([0;2;3;4;5;6],[1;7],2);([0;2;3;4;5;6],[1;7],0);([0;2;3;4;5;6],[1;7],3)]);
 ((2,4,1),[],[0;2],
  [([(0,1);(1,1);(1,3)],false,Decides 1 1 1 []);([(0,1)],false,Looks 1 [] [] 0);([(0,1)],false,Decides 0 1 1 []);
  ([],false,Arrives 1 []);([(1,2)],false,Decides 1 2 3 []);([],false,Looks 1 [] [] 0);([],false,Arrives 1 []);
  ([(1,3)],false,Looks 0 [] [] 0);([(0,1);(1,3)],false,Decides 0 1 3 []);([(1,3)],false,Looks 0 [] [] 0);
  ([(1,3)],false,Arrives 0 []);([(0,2);(1,3)],false,Decides 1 3 3 []);([(0,2)],false,Decides 0 2 3 []);
  ([],false,Looks 0 [] [] 0);([],true,Looks 1 [] [] 0);([],true,Ticks);([],false,Arrives 1 [])],
  [([0;1;2;3],[],1);([0;1;2;3],[],3)])].
Definition runs_REPAIRED : list ((nat * nat * nat) * list nat * list nat * list (list (nat * nat) * bool * event nat)
  * list (list nat * list nat * nat)) := [
 ((1,3,3),[6;0],[3],
  [([(0,0)],false,Decides 0 0 0 []);([],false,Looks 0 [] [] 0);([(0,6)],false,Decides 0 6 6 []);
  ([],false,Looks 0 [] [] 0);([(0,4)],false,Decides 0 4 4 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,1)],false,Decides 0 1 1 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,2)],false,Decides 0 2 2 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,5)],false,Decides 0 5 5 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,8)],false,Decides 0 8 8 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,7)],false,Decides 0 7 7 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 [])],
  [([1;2;3;4;5;7;8],[0;6],7)]);
 ((2,3,2),[4;2],[0;1],
  [([(0,3);(1,2)],false,Decides 0 3 3 []);([(1,2)],false,Decides 1 2 2 [0]);([],false,Looks 1 [] [] 0);
  ([(1,4)],false,Decides 1 4 4 []);([],false,Looks 1 [] [] 0);([(1,0)],false,Looks 0 [] [] 0);
  ([(1,0)],false,Arrives 0 [])],
  [([0;1;3],[2;4],3);([0;1;3],[2;4],1)]);
 ((3,3,2),[2;5],[3;1;0],
  [([(0,4);(1,2);(2,1)],false,Decides 2 1 2 [1]);([(0,4);(1,2)],false,Looks 2 [0] [1] 0);
  ([(0,4);(1,2)],true,Ticks);([(0,4);(1,2)],true,Decides 0 4 4 []);([(1,2)],true,Decides 1 2 2 []);
  ([],false,Looks 0 [] [] 1);([],false,Arrives 0 []);([(0,5)],false,Looks 1 [] [] 1);
  ([(0,5);(1,4)],true,Decides 0 5 5 []);([(1,4)],true,Looks 0 [] [] 0)],
  [([0;1;3;4],[2;5],4);([0;1;3;4],[2;5],1);([0;1;3;4],[2;5],0)]);
 ((4,3,2),[0;1],[4;3;5;2],
  [([(0,1);(1,0);(2,2);(3,1)],false,Decides 2 2 1 [0;3]);([(0,1);(1,0);(3,1)],false,Looks 2 [] [3] 1);
  ([(0,1);(1,0);(3,1)],true,Decides 1 0 0 []);([(0,1);(3,1)],false,Decides 0 1 1 []);
  ([(3,1)],false,Decides 3 1 1 []);([],false,Looks 1 [] [] 1);([(1,4)],true,Looks 3 [] [] 1);
  ([(1,4)],true,Decides 1 4 1 []);([],false,Looks 0 [] [] 0);([],false,Looks 1 [] [] 0)],
  [([2;3;4;5],[0;1],4);([2;3;4;5],[0;1],3);([2;3;4;5],[0;1],5);([2;3;4;5],[0;1],2)]);
 ((2,3,3),[2;5],[7;3],
  [([(0,8);(1,6)],false,Decides 0 8 8 [1]);([(1,6)],false,Decides 1 6 6 []);([],false,Looks 1 [] [] 0);
  ([],false,Arrives 1 []);([(1,3)],false,Looks 0 [] [] 0);([(1,3)],false,Decides 1 3 0 [0]);
  ([],false,Arrives 0 [1]);([(0,5)],false,Looks 1 [] [] 0);([(0,5)],false,Arrives 1 []);
  ([(0,5);(1,0)],false,Decides 1 0 0 []);([(0,5)],false,Decides 0 5 5 []);([],false,Looks 1 [] [] 0);
  ([],false,Arrives 1 []);([(1,1)],false,Decides 1 1 1 []);([],false,Looks 0 [] [] 0);
  ([(0,7)],false,Decides 0 7 4 []);([],false,Looks 1 [] [] 0);([],false,Arrives 1 []);
  ([(1,2)],false,Decides 1 2 2 []);([],false,Looks 1 [] [] 0);([(1,4)],false,Looks 0 [] [] 0);
  ([(1,4)],false,Arrives 0 []);([(0,4);(1,4)],false,Decides 0 4 4 []);([(1,4)],false,Looks 0 [] [] 0);
  ([(1,4)],false,Arrives 0 [])],
  [([0;1;3;4;6;7;8],[2;5],4);([0;1;3;4;6;7;8],[2;5],1)]);
 ((3,3,3),[3;8],[1;2;0],
  [([(0,4);(1,5);(2,3)],false,Decides 1 5 5 [0;2]);([(0,4);(2,3)],false,Looks 1 [] [] 0);
  ([(0,4);(2,3)],false,Arrives 1 [2]);([(0,4);(1,8);(2,3)],false,Decides 2 3 3 []);
  ([(0,4);(1,8)],false,Decides 0 4 4 []);([(1,8)],false,Looks 2 [] [] 0);([(1,8);(2,1)],false,Decides 2 1 4 []);
  ([(1,8)],false,Decides 1 8 8 []);([],false,Looks 2 [] [] 2);([],true,Ticks);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 0 []);([(0,7)],false,Looks 1 [] [] 0);([(0,7);(1,4)],true,Decides 1 4 7 []);
  ([(0,7)],false,Looks 1 [] [] 0);([(0,7)],true,Decides 0 7 7 []);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 0 []);([(0,6)],true,Decides 0 6 6 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 [])],
  [([0;1;2;4;5;6;7],[3;8],6);([0;1;2;4;5;6;7],[3;8],5);([0;1;2;4;5;6;7],[3;8],0)]);
 ((3,5,1),[3;2],[0;4;1],
  [([(0,1);(1,3);(2,2)],false,Decides 1 3 3 [0]);([(0,1);(2,2)],false,Decides 0 1 2 [1]);
  ([(2,2)],false,Looks 0 [1] [] 1);([(2,2)],false,Decides 2 2 2 []);([],false,Looks 2 [] [] 0);
  ([],false,Looks 1 [] [] 0)],
  [([0;1;4],[2;3],0);([0;1;4],[2;3],4);([0;1;4],[2;3],1)]);
 ((3,5,1),[4;3],[2;0;1],
  [([(0,3);(1,1);(2,2)],false,Decides 2 2 3 []);([(0,3);(1,1)],false,Looks 2 [1] [0] 0);
  ([(0,3);(1,1)],true,Decides 1 1 3 [0]);([(0,3)],true,Looks 1 [] [] 0);([(0,3)],true,Ticks);
  ([(0,3);(1,1)],false,Decides 1 1 3 []);([(0,3)],false,Looks 1 [] [] 1);([(0,3)],true,Ticks);
  ([(0,3);(2,2)],false,Decides 2 2 3 []);([(0,3)],false,Looks 2 [] [] 2);([(0,3)],true,Ticks);
  ([(0,3)],true,Ticks);([(0,3);(1,1)],false,Decides 1 1 3 []);([(0,3)],false,Decides 0 3 3 []);
  ([],false,Looks 0 [] [] 0);([],false,Looks 1 [] [] 0)],
  [([0;1;2],[3],2);([0;1;2],[3],0);([0;1;2],[3],1)]);
 ((3,5,1),[0;3],[2;4;1],
  [([(0,3);(1,3);(2,0)],false,Decides 1 3 3 []);([(0,3);(2,0)],false,Looks 1 [0] [] 0);
  ([(0,3);(2,0)],false,Decides 2 0 0 []);([(0,1)],false,Decides 0 1 0 [1]);([],false,Looks 0 [2] [] 1);
  ([],true,Looks 2 [] [] 0)],
  [([1;2;4],[0;3],2);([1;2;4],[0;3],4);([1;2;4],[0;3],1)]);
 ((3,5,1),[3;4],[1;0;2],
  [([(0,2);(1,1);(2,3)],false,Decides 2 3 3 [0]);([(0,2);(1,1)],false,Decides 0 2 3 [1;2]);
  ([(1,1)],false,Looks 0 [] [] 0);([(1,1)],true,Looks 2 [] [] 0)],
  [([0;1;2],[3],1);([0;1;2],[3],0);([0;1;2],[3],2)]);
 ((3,5,1),[2;4],[1;0;3],
  [([(0,2);(1,1);(2,4)],false,Decides 1 1 2 []);([(0,2);(2,4)],false,Looks 1 [2] [] 2);
  ([(0,2);(2,4)],true,Decides 0 2 2 [2]);([(2,4)],true,Decides 2 4 4 [0]);([],false,Looks 2 [] [] 2);
  ([(2,2)],true,Looks 0 [] [] 0)],
  [([0;1;3],[2;4],1);([0;1;3],[2;4],0);([0;1;3],[2;4],3)]);
 ((3,5,1),[3;4],[2;1;0],
  [([(0,3);(1,2);(2,1)],false,Decides 2 1 3 []);([(0,3);(1,2)],false,Looks 2 [0] [] 1);
  ([(0,3);(1,2)],true,Decides 0 3 3 [1]);([(1,2)],true,Decides 1 2 3 []);([],false,Looks 1 [] [0] 1);
  ([],true,Looks 0 [] [] 0)],
  [([0;1;2],[3],2);([0;1;2],[3],1);([0;1;2],[3],0)]);
 ((3,4,2),[0;7],[5;3;2],
  [([(0,4);(1,7);(2,1)],false,Decides 2 1 1 [0;1]);([(0,4);(1,7)],false,Decides 1 7 7 [0]);
  ([(0,4)],false,Looks 2 [] [] 0);([(0,4)],false,Looks 1 [] [] 0);([(0,1);(1,2)],false,Arrives 2 []);
  ([(0,6);(1,2);(2,0)],false,Decides 2 0 0 []);([(0,6);(1,2)],false,Decides 0 6 6 []);
  ([(1,2)],false,Looks 0 [] [] 0);([(1,2)],false,Decides 1 2 4 []);([],false,Arrives 0 []);
  ([(0,5)],false,Looks 2 [] [] 0);([(0,5);(2,5)],false,Decides 2 5 4 []);([(0,5)],false,Looks 2 [] [] 0);
  ([(0,5)],false,Decides 0 5 4 []);([],false,Arrives 2 []);([(2,4)],false,Looks 0 [] [] 2);
  ([(2,4)],true,Looks 1 [] [] 2);([(2,4)],true,Ticks);([(0,5);(2,4)],false,Decides 2 4 4 []);
  ([(0,5)],false,Arrives 1 []);([(0,5);(1,1)],false,Decides 1 1 4 []);([(0,5)],false,Decides 0 5 4 []);
  ([],false,Looks 1 [] [] 0);([],false,Arrives 1 []);([(1,5)],false,Looks 0 [] [] 0);
  ([(1,5)],true,Looks 2 [] [] 0);([(1,5)],true,Decides 1 5 4 []);([],false,Arrives 2 []);
  ([],false,Looks 1 [] [] 0);([],false,Arrives 1 [])],
  [([1;2;3;4;5;6],[0;7],6);([1;2;3;4;5;6],[0;7],5);([1;2;3;4;5;6],[0;7],4)]);
 ((3,4,2),[3;2],[6;5;7],
  [([(0,2);(1,4);(2,3)],false,Decides 2 3 3 []);([(0,2);(1,4)],false,Decides 1 4 4 [2]);
  ([(0,2)],false,Looks 1 [] [] 0);([(0,2)],false,Arrives 1 [2]);([(0,2);(1,0)],false,Decides 0 2 2 [1]);
  ([(1,0)],false,Looks 2 [] [] 0);([(1,0);(2,6)],false,Looks 0 [] [] 0);
  ([(0,5);(1,0);(2,6)],false,Decides 0 5 1 []);([(1,0);(2,6)],false,Decides 1 0 0 []);
  ([(2,6)],false,Looks 1 [] [] 0);([(2,6)],false,Arrives 1 []);([(1,1);(2,6)],false,Decides 1 1 1 []);
  ([(2,6)],false,Looks 1 [] [] 0);([(2,6)],false,Looks 0 [] [] 0);([(2,6)],false,Decides 2 6 1 []);
  ([],false,Arrives 1 []);([],false,Looks 2 [] [] 0);([],false,Arrives 0 [])],
  [([0;1;4;5;6;7],[2;3],5);([0;1;4;5;6;7],[2;3],1);([0;1;4;5;6;7],[2;3],7)]);
 ((3,4,2),[0;3],[2;6;1],
  [([(0,3);(1,5);(2,0)],false,Decides 1 5 5 []);([(0,3);(2,0)],false,Decides 2 0 0 []);
  ([(0,3)],false,Decides 0 3 3 [1;2]);([],false,Looks 0 [2] [] 0);([(0,6)],false,Looks 2 [] [] 0);
  ([(0,6);(2,2)],false,Decides 0 6 7 []);([(2,5)],false,Looks 0 [] [] 1);([(2,5)],false,Decides 2 5 5 []);
  ([],false,Looks 2 [] [] 1);([],false,Looks 1 [] [] 1);([],false,Arrives 1 []);([(1,4)],true,Ticks);
  ([(1,4);(2,5)],false,Decides 1 4 4 []);([(2,5)],false,Looks 1 [] [] 2);([(2,5)],false,Arrives 1 []);
  ([(1,5);(2,2)],false,Decides 1 5 7 []);([(2,2)],false,Decides 2 2 7 []);([],false,Looks 1 [] [] 2);
  ([],false,Looks 2 [] [] 2);([],true,Ticks);([(0,6)],false,Arrives 1 []);([(0,6);(1,6)],false,Decides 0 6 7 []);
  ([(1,6)],false,Looks 0 [] [] 0);([(1,6)],false,Decides 1 6 7 []);([],false,Looks 1 [] [] 0);
  ([],false,Arrives 0 []);([(0,7)],true,Ticks);([(0,7);(1,6)],false,Decides 1 6 7 []);
  ([(0,7)],false,Decides 0 7 7 []);([],false,Looks 1 [] [] 1);([],true,Ticks);([(2,2)],false,Looks 0 [] [] 2);
  ([(2,2)],false,Decides 2 2 7 []);([],false,Arrives 0 []);([],false,Looks 2 [] [] 0);([],false,Arrives 2 [])],
  [([1;2;4;5;6;7],[0;3],7);([1;2;4;5;6;7],[0;3],5);([1;2;4;5;6;7],[0;3],2)]);
 ((3,4,2),[3;5],[1;0;6],
  [([(0,2);(1,4);(2,5)],false,Decides 1 4 4 []);([(0,2);(2,5)],false,Looks 1 [] [] 0);
  ([(0,2);(2,5)],false,Decides 0 2 2 [2]);([(2,5)],false,Arrives 1 [2]);([(1,5);(2,5)],false,Decides 2 5 5 []);
  ([(1,5)],false,Looks 2 [0] [] 0);([(1,0);(2,7)],false,Decides 1 0 2 []);([(2,7)],false,Decides 2 7 7 []);
  ([],false,Looks 1 [] [] 0);([],false,Looks 2 [] [] 0);([],false,Looks 0 [] [] 0);([],false,Arrives 2 []);
  ([(2,3)],false,Decides 2 3 3 []);([],false,Arrives 0 []);([(0,3)],false,Decides 0 3 3 []);
  ([],false,Looks 2 [] [] 0);([],false,Arrives 1 []);([(1,1)],false,Decides 1 1 3 []);([],false,Looks 1 [] [] 0);
  ([],false,Arrives 1 []);([(1,2)],false,Decides 1 2 3 []);([],false,Looks 0 [] [] 0);([],false,Looks 1 [] [] 0)],
  [([0;1;2;4;6;7],[3;5],2);([0;1;2;4;6;7],[3;5],1);([0;1;2;4;6;7],[3;5],7)]);
 ((2,5,1),[],[2;4],
  [([(0,3);(1,3)],false,Decides 0 3 3 []);([(1,3)],false,Looks 0 [] [] 0);([(1,3)],false,Decides 1 3 3 []);
  ([],false,Arrives 0 []);([(0,2)],false,Decides 0 2 1 []);([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);
  ([(0,1)],false,Looks 1 [] [] 0);([(0,1);(1,3)],false,Decides 0 1 1 []);([(1,3)],false,Looks 0 [] [] 0);
  ([(1,3)],false,Arrives 0 []);([(0,0);(1,3)],false,Decides 1 3 0 []);([(0,0)],false,Decides 0 0 0 []);
  ([],false,Looks 0 [] [] 0);([],false,Arrives 0 []);([],false,Looks 1 [] [] 0);([],false,Arrives 1 [])],
  [([0;1;2;3;4],[],0);([0;1;2;3;4],[],3)]);
 ((4,4,3),[0],[9;10;5;2],
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
  ([],true,Looks 1 [] [] 0);([],true,Ticks);([(1,6)],false,Decides 1 6 6 []);([],false,Looks 1 [] [] 1);
  ([],true,Ticks);([],true,Ticks);([],true,Ticks);([(0,5)],false,Decides 0 5 6 []);([],false,Looks 0 [] [] 0);
  ([],false,Arrives 0 []);([(0,6)],false,Decides 0 6 6 []);([],false,Looks 0 [] [] 0)],
  [([1;2;3;4;5;6;7;8;9;10;11],[0],5);([1;2;3;4;5;6;7;8;9;10;11],[0],10);([1;2;3;4;5;6;7;8;9;10;11],[0],6);
  ([1;2;3;4;5;6;7;8;9;10;11],[0],3)])].
